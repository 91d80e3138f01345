#!/usr/bin/env bash
# Installs what `cargo xtask embedded` and `cargo xtask counts` need. Debian, as root; nothing that is
# installed is removed or replaced, and rustup's toolchain stays the first in the path.
set -euo pipefail
cd "$(dirname "$0")/.."
export DEBIAN_FRONTEND=noninteractive
packages=(gcc libc6-dev valgrind rustc-web rust-web-src)
install=(apt-get install -y -qq --no-remove --no-upgrade --no-install-recommends)
tools="${CARGO_TARGET_DIR:-target}/embedded/tools"

emulator_runs() {
    qemu-system-arm --version || "$tools/usr/bin/qemu-system-arm" --version
}
if dpkg -s "${packages[@]}" &> /dev/null && emulator_runs &> /dev/null; then
    exit 0
fi

apt-get update -qq
"${install[@]}" "${packages[@]}"
command -v qemu-system-arm > /dev/null && exit 0
"${install[@]}" qemu-system-arm && exit 0

# Other packages of QEMU, of another version, are in its way: unpack the one program beside.
echo "qemu-system-arm cannot be installed; it is unpacked into the target folder instead"
mapfile -t libraries < <(apt-cache depends qemu-system-arm | awk '/^  Depends: lib/ {print $2}')
"${install[@]}" "${libraries[@]}"
mkdir -p "$tools"
tools=$(cd "$tools" && pwd)
cd "$tools"
apt-get download -qq qemu-system-arm
dpkg -x qemu-system-arm_*.deb .
rm qemu-system-arm_*.deb
