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
draw workspaces workspace examples/workspaces/five-kinds.toml maximal --overlay inclusive:-45:45 --overlay constant:0 --overlay total:-45:45 --overlay dextrous
draw maximal workspace examples/workspaces/table1-1a.toml maximal
draw coupler coupler examples/coupler.json
draw nine-link group examples/nine-link.json
draw seven-link group examples/seven-link.json
draw chain group examples/chain.json --inputs=0.1
draw hana hana workspace examples/hana.toml constant --phi=0
draw hana-modes hana forward examples/hana.toml --inputs=1,-0.5,0.3
draw multipteron multipteron forward examples/quadrupteron.toml --inputs=0.8,1.2,0.9,0.4
draw tripod tripod inverse examples/tripod-cartesian.toml --pose=200,260,240,10,5,-3
# Every family of the catalogue, at inputs that its model comes with.
for family in 3-RPR 3-RRR 3-PRR 3-RRP 3-PRP 3-PPR 3-RPP R_P_R,_P_RR,_R_RP; do
  model=target/guide-model.toml
  "$assur" new "$family" --output "$model"
  inputs=$(sed -n 's/.*--inputs=//p' "$model")
  draw "family-$(tr 'A-Z,' 'a-z-' <<<"$family" | tr -d _)" forward "$model" "--inputs=$inputs"
done
# The page of the explorer, where its tests have left a picture: (cd tests/web && npm test -- ../../target/explorer)
page=target/explorer/workspace-maximal.png
{
  if [ -f "$page" ]; then
    cp "$page" "$pictures/explorer.png"
    echo "![A 3-RPR in the explorer: the modes, and the maximal workspace that follows the mouse](pictures/explorer.png)"
  fi
} > "$pictures/explorer.md"
if [ "${1:-}" != pictures ]; then
  mdbook build docs
  # Every picture that a page shows has been drawn.
  (cd docs/book && grep -o 'src="[^"]*pictures/[^"]*"' ./*.html catalogue/*.html | sed 's/:src="/ /; s/"$//' | while read -r file picture; do
    [ -f "$(dirname "$file")/$picture" ] || { echo "$file shows $picture, which is not there" >&2; exit 1; }
  done)
fi
