# The Debian packages, for the preset `package`: its prefix is /usr.
set(BVHIO_MAINTAINER "the bvhx authors <bvhx@packages.invalid>" CACHE STRING "Who answers for the packages: NAME <ADDRESS>")
set(version ${PROJECT_VERSION}-1)
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # SOURCE_DATE_EPOCH fixes it
configure_file(changelog.in changelog @ONLY)
find_program(GZIP gzip REQUIRED)
execute_process(COMMAND ${GZIP} -9nfk changelog WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR} COMMAND_ERROR_IS_FATAL ANY)
configure_file(${PROJECT_SOURCE_DIR}/CHANGELOG.md changes COPYONLY)
execute_process(COMMAND ${GZIP} -9nfk changes WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR} COMMAND_ERROR_IS_FATAL ANY)

set(packages bvhio libbvhio1 libbvhio-dev)
set(components tools runtime development)
foreach(package component IN ZIP_LISTS packages components)
  set(place ${CMAKE_INSTALL_DATADIR}/doc/${package})
  install(FILES copyright DESTINATION ${place} COMPONENT ${component})
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz DESTINATION ${place} RENAME changelog.Debian.gz COMPONENT ${component})
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/changes.gz DESTINATION ${place} RENAME changelog.gz COMPONENT ${component})
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL ${components})
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PACKAGE_VENDOR "the bvhx authors")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${BVHIO_MAINTAINER}")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")

# The first line of each description is the package's summary, in place of the project's.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")
set(about "Bounding volume hierarchies (BVHs) are the search trees of ray tracing.
The .bvhx format stores them, with their triangles, checked and compact.")
set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME bvhio)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SUGGESTS "python3, python3-matplotlib")
set(CPACK_COMPONENT_TOOLS_DESCRIPTION "tools for bounding volume hierarchies of ray tracing
${about}

This package has six programs that build such trees from 3D files, improve
them, lay them out for caches, compress them, trace rays through them and
report what they hold and cost.")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME libbvhio1)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_SOURCE_DIR}/triggers)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "library for bounding volume hierarchies of ray tracing
${about}

This package has the shared libraries: libbvhio, and its part libbvhio-read,
which opens, checks and traces but needs few other libraries.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libbvhio-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libbvhio1 (= ${version})")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "library for bounding volume hierarchies of ray tracing - development
${about}

This package has the header for C and its wrapper for C++, the static
libraries, and a corpus of valid and damaged files for tests of readers.")
include(CPack)
