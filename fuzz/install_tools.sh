#!/usr/bin/env bash
# Installs what `cargo xtask fuzz` needs: cargo-fuzz, into the target folder, and a C++ compiler for
# libFuzzer. Debian, as root.
set -euo pipefail
cd "$(dirname "$0")/.."
version=0.13.2
tools="${CARGO_TARGET_DIR:-target}/fuzz-tools"

if ! command -v c++ > /dev/null; then
    export DEBIAN_FRONTEND=noninteractive
    apt-get update -qq
    apt-get install -y -qq --no-remove --no-upgrade --no-install-recommends g++
fi
if ! "$tools/bin/cargo-fuzz" fuzz --version 2> /dev/null | grep -qF "$version"; then
    cargo install --quiet --locked cargo-fuzz --version "$version" --root "$tools"
fi
