// How bvh-compress and the C API store a file's tree in another form.
#pragma once

#include <string>
#include <string_view>

#include "file/bvhx_file.h"

namespace bvhio {

/// What the form called `form` does to a tree. Throws Error{usage} for an unknown name.
const FormTraits& traitsOf(std::string_view form);

/// The file's tree with the boxes that it is about: those of a compact form are larger.
Bvh exactTree(const BvhxFile& file);

/// Settles the form where none was asked for (`form` is empty), and returns the options that are to be when
/// none are given. A compact form stays what it is.
EncodeOptions settleForm(std::string& form, const BvhxFile& file);

/// Whether the tree is in that form already, encoded with those options.
bool isStoredAs(const EncodedBvh& bvh, std::string_view form, const EncodeOptions& options);

/// Stores the tree, or both levels of an instanced scene's trees, in that form, unless they are so already.
/// Throws Error: usage where the form does not hold instances; unsupported where it cannot hold the tree.
void changeForm(BvhxFile& file, const std::string& form, const EncodeOptions& options);

/// Puts each geometry's triangles in the order in which the tree's leaves have them.
void orderTrianglesByLeaves(BvhxFile& file);

}  // namespace bvhio
