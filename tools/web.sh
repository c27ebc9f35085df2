#!/usr/bin/env bash
# The JavaScript module and the playground.
#
#   tools/web.sh tools    whether the tools are here or can be had; installs them with apt-get as root
#   tools/web.sh build    build/web/module (the package for npm) and build/web/playground.html
#
# The module is compiled for wasm32 by the Rust toolchain in use, if it has that target (rustup target add
# wasm32-unknown-unknown), else by Debian's rustc-web, with a standard library that is compiled on the way.
set -euo pipefail
cd "$(dirname "$0")/.."

TARGET=wasm32-unknown-unknown
OUT=build/web
MODULE=$OUT/module
MOST=150000 # bytes of the module, compressed

has() { command -v "$1" >/dev/null; }
has_target() { [ -d "$(rustc --print sysroot)/lib/rustlib/$TARGET/lib" ]; }
has_debian() { [ -x /usr/bin/rustc ] && [ -x /usr/bin/cargo ] && [ -d /usr/lib/rustlib/src/rust/library ] && rust-lld -flavor wasm --version >/dev/null 2>&1; }

wanted() {
  has chromium || echo chromium
  has node || echo nodejs
  has npm || echo npm
  has_target || has_debian || echo rustc-web cargo-web rust-web-src rust-web-llvm
}

install() {
  local packages
  packages=$(wanted)
  [ -n "$packages" ] || return 0
  has apt-get && [ "$(id -u)" = 0 ] || { echo "web: missing: $packages" >&2; return 1; }
  apt-get update -q >/dev/null && DEBIAN_FRONTEND=noninteractive apt-get install -y -q $packages >/dev/null || {
    echo "web: cannot be had: $packages" >&2
    return 1
  }
}

compile() {
  local arguments=(build --quiet --locked --profile web --package forgetting-wasm --target $TARGET --target-dir target/web)
  if has_target; then
    cargo "${arguments[@]}"
  else
    RUSTC=/usr/bin/rustc RUSTC_BOOTSTRAP=1 /usr/bin/cargo "${arguments[@]}" -Z build-std=std,panic_abort
  fi
}

npm_packages() {
  local folder=$1
  cmp -s "$folder/package.json" "$folder/node_modules/.of" && return 0
  npm install --prefix "$folder" --no-package-lock --no-audit --no-fund --loglevel=error
  cp "$folder/package.json" "$folder/node_modules/.of"
}

module() {
  compile
  cargo build --quiet --locked --release --manifest-path tools/bindgen/Cargo.toml --target-dir target/bindgen
  rm -rf "$MODULE.new"
  target/bindgen/release/bindgen target/web/$TARGET/web/forgetting_wasm.wasm "$MODULE.new"
  docs/playground/node_modules/.bin/wasm-opt -Oz --all-features --disable-gc --disable-custom-descriptors --disable-strings \
    "$MODULE.new/forgetting_bg.wasm" -o "$MODULE.new/forgetting_bg.wasm"
  cp LICENSE-MIT LICENSE-APACHE crates/forgetting-wasm/README.md "$MODULE.new"
  python3 tools/npm_package.py "$MODULE.new"
  rm -rf "$MODULE" && mv "$MODULE.new" "$MODULE"
  local bytes
  bytes=$(cat "$MODULE/forgetting.js" "$MODULE/forgetting_bg.wasm" | gzip -9 | wc -c)
  echo "$MODULE: $bytes bytes compressed, at most $MOST"
  [ "$bytes" -le "$MOST" ]
}

case "${1:-}" in
  tools) install ;;
  build)
    install
    mkdir -p $OUT
    npm_packages docs/playground
    module
    node docs/playground/build.mjs "$MODULE" $OUT/playground.html
    ;;
  *) sed -n '2,9s/^# \{0,1\}//p' "$0"; exit 2 ;;
esac
