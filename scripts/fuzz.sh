#!/usr/bin/env bash
# Coverage-guided fuzzing with libFuzzer on the pinned toolchain:
#   scripts/fuzz.sh case|checkpoint|frame SECONDS   fuzzes; a finding ends it and is kept
#   scripts/fuzz.sh case|checkpoint|frame FILE      runs one input again
#   scripts/fuzz.sh seeds                           writes seeds anew, when the state's layout changed
# New inputs are kept in fuzz/target/corpus; the small corpus in the repository is only read.
set -euo pipefail
target=${1:?case, checkpoint, frame or seeds} what=${2:-60}
if [ -f "$what" ]; then what=$(realpath "$what"); fi
cd "$(dirname "$0")/../fuzz"
# What cargo-fuzz passes, without the address sanitizer, which needs another toolchain.
export RUSTFLAGS="--cfg fuzzing -Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4
  -Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table
  -Cllvm-args=-sanitizer-coverage-trace-compares"
RUSTFLAGS=$(echo $RUSTFLAGS)
host=$(rustc -vV | sed -n 's/^host: //p')
if [ "$target" = seeds ]; then
  export WINGBEAT_SEEDS=corpus
  target=checkpoint
fi
cargo build --release --locked --target "$host" --bin "$target"
program=target/$host/release/$target
if [ -f "$what" ]; then
  exec "$program" "$what"
fi
mkdir -p "target/corpus/$target" "target/findings/$target"
seeds=("corpus/$target")
options=(-max_total_time="$what" -timeout=20 -rss_limit_mb=4096 -print_final_stats=1
  -artifact_prefix="target/findings/$target/")
if [ "$target" = case ]; then
  seeds+=(../crates/wingbeat-case/presets)
  options+=(-dict=case.dict -max_len=6000)
fi
exec "$program" "${options[@]}" "target/corpus/$target" "${seeds[@]}"
