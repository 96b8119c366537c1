#!/usr/bin/env bash
# Makes the Debian packages, has lintian check them, and installs them in a fresh Debian 12, where the tools and a program that links
# the library must run. Needs root, and a mirror of Debian: the machine's own, or BVHIO_DEBIAN_MIRROR. Keeps the fresh system
# in BUILD/rootfs for the next time. Usage: tests/package.sh BUILD (the preset `package`)
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
build=$(realpath "$1")
packages=$build/packages
rm -rf "$packages"
(cd "$build" && cpack -B "$packages" >"$build/cpack.log") || { cat "$build/cpack.log"; exit 1; }
rm -rf "$packages/_CPack_Packages"
ls -s --block-size=K "$packages"
[ "$(ls "$packages" | sed 's/_.*//' | tr '\n' ' ')" = "bvhio libbvhio-dev libbvhio1 " ]

lintian --fail-on error --allow-root "$packages"/*.deb

fresh=$build/rootfs
mirror=${BVHIO_DEBIAN_MIRROR:-$(sed -nE 's/^deb (\[[^]]*\] )?(http[^ ]*) .*/\2/p; s/^URIs: (http[^ ]*).*/\1/p' \
    /etc/apt/sources.list /etc/apt/sources.list.d/* 2>/dev/null | head -1 || true)}
if [ ! -e "$fresh/ready" ]; then
    rm -rf "$fresh"
    debootstrap --variant=minbase bookworm "$fresh" ${mirror:+"$mirror"} >"$build/debootstrap.log" ||
        { tail "$build/debootstrap.log"; exit 1; }
    touch "$fresh/ready"
fi
# Unpacked anew each time over the same fresh system.
system=$build/system
rm -rf "$system"
cp -a "$fresh" "$system"
cp "$packages"/*.deb tests/consumers/uses.c samples/scenes/courtyard.glb "$system/root/"
cp /etc/resolv.conf "$system/etc/" 2>/dev/null || true
for file in /etc/apt/apt.conf.d/*; do cp "$file" "$system/etc/apt/apt.conf.d/" 2>/dev/null || true; done
chroot "$system" /bin/sh -eu <<'INSIDE'
cd /root
export DEBIAN_FRONTEND=noninteractive
apt-get update -qq
apt-get install -y -qq --no-install-recommends ./*.deb gcc libc6-dev pkg-config >/root/install.log 2>&1 || { tail /root/install.log; exit 1; }
bvh-build courtyard.glb -o scene.bvhx
bvh-compress scene.bvhx --geometry draco -o small.bvhx
bvh-stats --check small.bvhx
bvh-trace small.bvhx --rays ao --count 10000 >/dev/null
gcc uses.c $(pkg-config --cflags --libs bvhio) -o uses
gcc uses.c $(pkg-config --cflags --libs bvhio-read) -o reads
./uses && ./reads
test -e /usr/share/man/man1/bvh-build.1.gz
test -e /usr/share/bash-completion/completions/bvh-build
test -e /usr/share/bvhio/corpus/malformed/manifest.csv
apt-get remove -y -qq bvhio libbvhio-dev libbvhio1 >/dev/null 2>&1
test ! -e /usr/bin/bvh-build
INSIDE
rm -rf "$system"
echo "The packages install and work in a fresh system"
