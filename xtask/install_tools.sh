#!/usr/bin/env bash
# Installs what `cargo xtask deny` needs: cargo-deny, into the target folder.
set -euo pipefail
cd "$(dirname "$0")/.."
version=0.20.2
tools="${CARGO_TARGET_DIR:-target}/deny-tools"

if ! "$tools/bin/cargo-deny" --version 2> /dev/null | grep -qF "$version"; then
    cargo install --quiet --locked cargo-deny --version "$version" --no-default-features --root "$tools"
fi
