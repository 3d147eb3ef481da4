"""Measures every system that is there on the same triads, and writes the table; run.py installs and calls this."""

from __future__ import annotations

import argparse
import datetime
import json
import os
import statistics
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

from .homotopy_peers import bertini_answers, macaulay2_answers, phcpack_answers
from .msolve_peer import msolve_answer
from .problems import Answer, Leg, Solution, is_real, planted, residual, same
from .root_peers import flint_answer, mpsolve_answer, numpy_answer

ROOT = Path(__file__).resolve().parent.parent.parent
TARGET = ROOT / "target" / "peers"

LEFT_OUT = [
    (
        "HomotopyContinuation.jl",
        "Julia itself is in none of the package registries that the others come from; `juliacall` and `jill` download it from elsewhere",
    ),
]

PEERS: dict[str, Callable[[list[list[Leg]]], Answer | list[Answer]]] = {
    "numpy": numpy_answer,
    "mpsolve": mpsolve_answer,
    "flint": flint_answer,
    "macaulay2": macaulay2_answers,
    "bertini": bertini_answers,
    "phcpack": phcpack_answers,
    "msolve": msolve_answer,
}


def ours(triads: list[list[Leg]]) -> list[Answer]:
    """The routes of assur, by the example `peers_ours`; the first is the reference route, complete."""
    place = TARGET / "problems.json"
    legs = [[{"a": [leg.a.real, leg.a.imag], "b": [leg.b.real, leg.b.imag], "l": leg.length} for leg in triad] for triad in triads]
    place.write_text(json.dumps({"triads": legs}))
    command = ["cargo", "run", "--quiet", "--release", "--example", "peers_ours", "--", str(place)]
    lines = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout.splitlines()

    def answer(line: str) -> Answer:
        fields = json.loads(line)
        solutions = [[(complex(*s[0:2]), complex(*s[2:4]), complex(*s[4:6])) for s in found] for found in fields.pop("solutions")]
        return Answer(solutions=solutions, **fields)

    return [answer(line) for line in lines]


def found(triads: list[list[Leg]], wanted: list[list[Solution]], answer: Answer) -> tuple[int, int]:
    """How many of the wanted solutions an answer has, and how many of its own are none of them."""
    hits = strange = 0
    for legs, truth, listed in zip(triads, wanted, answer.solutions, strict=True):
        hits += sum(any(same(legs, s, t) for t in listed) for s in truth)
        strange += sum(not any(same(legs, s, t) for t in truth) for s in listed)
    return hits, strange


def duration(seconds: float) -> str:
    """Three digits with a unit."""
    for unit, scale in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= scale:
            return f"{seconds / scale:.3g} {unit}"
    return f"{seconds / 1e-6:.2g} µs"


def row(triads: list[list[Leg]], truth: list[list[Solution]], answer: Answer) -> str:
    """One line of the table."""
    wanted = [[s for s in all_ if is_real(s)] for all_ in truth] if answer.real_only else truth
    hits, strange = found(triads, wanted, answer)
    of = sum(map(len, wanted))
    count = f"{hits} of {of}{' real' if answer.real_only else ''}" + (f", {strange} false" if strange else "")
    residuals = sorted(residual(legs, s) for legs, listed in zip(triads, answer.solutions, strict=True) for s in listed)
    median, worst = (residuals[len(residuals) // 2], residuals[-1]) if residuals else (float("nan"),) * 2
    ordered = sorted(answer.seconds)
    slow = ordered[9 * len(ordered) // 10]
    cells = [
        answer.system,
        duration(statistics.median(ordered)),
        duration(slow),
        count,
        f"{median:.0e}, {worst:.0e}",
        answer.certified,
        answer.note,
    ]
    return "| " + " | ".join(cells) + " |"


def main() -> None:
    """Asks every system and prints the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--triads", type=int, default=100, help="how many random RR-RR-RR triads")
    parser.add_argument("--seed", type=int, default=4, help="of the triads")
    parser.add_argument("--only", nargs="*", choices=PEERS, help="these systems beside ours")
    options = parser.parse_args()
    triads = planted(options.triads, options.seed)
    own = ours(triads)
    truth = own[0].solutions
    answers, left_out = list(own), list(LEFT_OUT)
    for name, peer in PEERS.items():
        if options.only is not None and name not in options.only:
            continue
        print(f"{name} ...", file=sys.stderr, flush=True)
        try:
            result = peer(triads)
        except (ImportError, OSError, RuntimeError, ValueError) as reason:
            left_out.append((name, str(reason)))
            continue
        for answer in result if isinstance(result, list) else [result]:
            assert len(answer.seconds) == len(answer.solutions) == len(triads), answer.system
            answers.append(answer)
    load = ", ".join(f"{x:.1f}" for x in os.getloadavg())
    real = sum(is_real(s) for listed in truth for s in listed)
    lines = [
        f"{len(triads)} random RR-RR-RR triads (seed {options.seed}), {sum(map(len, truth))} solutions, {real} of them real; "
        f"{datetime.datetime.now(datetime.UTC).date()}; load {load} at the end.",
        "",
        "| system | time per solve, median | 90 % below | solutions found | residual: median, worst | certified | how |",
        "|---|---|---|---|---|---|---|",
        *(row(triads, truth, answer) for answer in answers),
        "",
        *(f"Left out: {name}: {reason}." for name, reason in left_out),
    ]
    table = "\n".join(lines) + "\n"
    (TARGET / "table.md").write_text(table)
    print(table)


if __name__ == "__main__":
    main()
