#!/usr/bin/env bash
# Instructions per solve of the fast route, from two runs under valgrind: the same on a busy machine as on an idle one.
set -euo pipefail
cd "$(dirname "$0")/.."
cargo build --release --example instructions
count() {
  valgrind --tool=callgrind --callgrind-out-file=/dev/null target/release/examples/instructions "$1" 2>&1 |
    awk '/refs/ { gsub(",", "", $NF); print $NF }'
}
one=$(count 1)
three=$(count 3)
echo "RR-RR-RR, Triad::real_modes: $(((three - one) / 2000)) instructions per solve"
