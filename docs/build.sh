#!/usr/bin/env bash
# Draws the guide's pictures with the program itself and builds the book into docs/book. Needs mdbook; takes the program from ASSUR or target/release.
set -euo pipefail
cd "$(dirname "$0")/.."
assur=${ASSUR:-target/release/assur}
pictures=docs/src/pictures
mkdir -p "$pictures"

draw() { local name=$1; shift; "$assur" "$@" --svg "$pictures/$name.svg" >/dev/null; }

draw modes forward examples/3-rpr.toml --inputs=14.98,15.38,12
draw singularities singularities examples/3-rrr.toml --phi=17 --no-polynomial
draw workspace workspace examples/workspaces/table1-1a.toml maximal --overlay constant:0
draw coupler coupler examples/coupler.json
draw nine-link group examples/nine-link.json
draw seven-link group examples/seven-link.json
draw chain group examples/chain.json --inputs=0.1
draw hana hana workspace examples/hana.toml constant --phi=0
# Every family of the catalogue, at inputs that its model comes with.
for family in 3-RPR 3-RRR 3-PRR 3-RRP 3-PRP 3-PPR 3-RPP R_P_R,_P_RR,_R_RP; do
  model=target/guide-model.toml
  "$assur" new "$family" --output "$model"
  inputs=$(sed -n 's/.*--inputs=//p' "$model")
  draw "family-$(tr 'A-Z,' 'a-z-' <<<"$family" | tr -d _)" forward "$model" "--inputs=$inputs"
done
if [ "${1:-}" != pictures ]; then
  mdbook build docs
fi
