#!/usr/bin/env bash
# Installs what `cargo xtask deny` needs: cargo-deny, into the target folder. With --book it installs mdBook
# there instead, for `target/book-tools/bin/mdbook build book`.
set -euo pipefail
cd "$(dirname "$0")/.."
target="${CARGO_TARGET_DIR:-target}"

if [ "${1:-}" = --book ]; then
    version=0.5.4
    if ! "$target/book-tools/bin/mdbook" --version 2> /dev/null | grep -qF "$version"; then
        cargo install --quiet --locked mdbook --version "$version" --no-default-features --features search \
            --root "$target/book-tools"
    fi
    exit 0
fi

version=0.20.2
tools="$target/deny-tools"

if ! "$tools/bin/cargo-deny" --version 2> /dev/null | grep -qF "$version"; then
    cargo install --quiet --locked cargo-deny --version "$version" --no-default-features --root "$tools"
fi
