#!/usr/bin/env bash
# The JavaScript module and the playground.
#
#   tools/web.sh tools    whether the tools are here or can be had; installs them with apt-get as root
#   tools/web.sh build    build/web/module (the package for npm) and build/web/playground.html
#
# The module is compiled for wasm32 with a standard library that is compiled on the way: by the Rust toolchain in
# use, if it has the source of one (rustup component add rust-src), else by Debian's rustc-web.
set -euo pipefail
cd "$(dirname "$0")/.."

TARGET=wasm32-unknown-unknown
OUT=build/web
MODULE=$OUT/module
FEATURES="--enable-bulk-memory --enable-bulk-memory-opt --enable-sign-ext --enable-nontrapping-float-to-int --enable-mutable-globals --enable-reference-types --enable-multivalue --enable-simd --enable-call-indirect-overlong" # what the compiler uses
MOST=195000 # bytes of the module, compressed: a change that adds much to it is seen

has() { command -v "$1" >/dev/null; }
has_source() { [ -f "$(rustc --print sysroot)/lib/rustlib/src/rust/library/Cargo.lock" ] && has_linker; }
has_linker() { [ -x "$(rustc --print sysroot)/lib/rustlib/$(rustc -vV | sed -n 's/^host: //p')/bin/rust-lld" ]; }
has_debian() { [ -x /usr/bin/rustc ] && [ -x /usr/bin/cargo ] && [ -d /usr/lib/rustlib/src/rust/library ] && rust-lld -flavor wasm --version >/dev/null 2>&1; }

# the linker that rust-web-llvm has a link to
linker() { apt-cache show rust-web-llvm | sed -n 's/^Depends:.*\bllvm-\([0-9]*\).*/lld-\1/p' | head -n 1; }

wanted() {
  has chromium || echo chromium
  has node || echo nodejs
  has npm || echo npm
  has_source || has_debian || echo rustc-web cargo-web rust-web-src rust-web-llvm "$(linker)"
}

install() {
  local packages
  packages=$(wanted 2>/dev/null)
  [ -n "$packages" ] || return 0
  if ! has apt-get || [ "$(id -u)" != 0 ]; then
    echo "web: missing:" $packages >&2
    return 1
  fi
  apt-get update -q >/dev/null || true
  packages=$(wanted)
  DEBIAN_FRONTEND=noninteractive apt-get install -y -q $packages >/dev/null || {
    echo "web: cannot be had:" $packages >&2
    return 1
  }
}

compile() {
  local arguments=(build --quiet --locked --profile web --package forgetting-wasm --target $TARGET --target-dir target/web)
  arguments+=(-Zbuild-std=std,panic_abort -Zbuild-std-features=optimize_for_size)
  # a panic ends the module without a word: its words would be a tenth of it
  local flags="-Zunstable-options -Cpanic=immediate-abort -Zlocation-detail=none"
  if has_source; then
    RUSTC_BOOTSTRAP=1 RUSTFLAGS=$flags cargo "${arguments[@]}"
  else
    RUSTC_BOOTSTRAP=1 RUSTFLAGS=$flags RUSTC=/usr/bin/rustc /usr/bin/cargo "${arguments[@]}"
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
  docs/playground/node_modules/.bin/wasm-opt -Oz $FEATURES "$MODULE.new/forgetting_bg.wasm" -o "$MODULE.new/forgetting_bg.wasm"
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
