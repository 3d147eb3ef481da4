"""Proved assembly modes of random RR-RR-RR triads: python-flint beside assur, in one run.

    pip install python-flint
    cargo build --release && python3 benches/peers/flint.py

FLINT's side: T(theta) from sampled balls, certified roots of the sextic (acb_poly.roots), which of them lie on the unit circle, back-substitution
for u in ball arithmetic. Ours: `assur triad --certify` proves the same triads for the counts; times are those that `cargo bench --bench certify` prints.
"""
import json, math, random, statistics, subprocess, sys, tempfile, time
from flint import acb, acb_poly, arb, ctx

ctx.prec = 106
I = acb(0, 1)


def triad(rng):
    x, y, turn = rng.uniform(-5, 5), rng.uniform(-5, 5), rng.uniform(-math.pi, math.pi)
    legs = []
    for _ in range(3):
        a, b = [rng.uniform(-5, 5) for _ in range(2)], [rng.uniform(-5, 5) for _ in range(2)]
        jx = x + math.cos(turn) * b[0] - math.sin(turn) * b[1]
        jy = y + math.sin(turn) * b[0] + math.cos(turn) * b[1]
        legs.append({"type": "RR", "a": a, "b": b, "l": math.hypot(jx - a[0], jy - a[1])})
    return sorted(legs, key=lambda leg: leg["l"])


def flint_modes(legs):
    """Boxes (theta, u) of the real modes."""
    a = [acb(*leg["a"]) for leg in legs]
    b = [acb(*leg["b"]) for leg in legs]
    l = [arb(leg["l"]) for leg in legs]
    conj = lambda z: acb(z.real, -z.imag)
    # Rows A u + B v + C = 0 times theta, as polynomials in theta.
    rows = []
    for i in (1, 2):
        beta, alpha = b[i] - b[0], a[i] - a[0]
        constant = beta * conj(beta) + alpha * conj(alpha) - acb((l[i] - l[0]) * (l[i] + l[0]))
        A = acb_poly([conj(beta), -conj(alpha)])
        B = acb_poly([0, -alpha, beta])
        C = acb_poly([-alpha * conj(beta), constant, -conj(alpha) * beta])
        rows.append((A, B, C))
    (A2, B2, C2), (A3, B3, C3) = rows
    U, V, D = B2 * C3 - B3 * C2, C2 * A3 - C3 * A2, A2 * B3 - A3 * B2
    t = U * V - acb_poly([acb(l[0] * l[0])]) * D * D
    coefficients = [t[k] for k in range(1, 8)]  # theta^0 and theta^8 vanish identically
    found = []
    for theta in acb_poly(coefficients).roots():
        if (abs(theta) - 1).contains(0):
            found.append((theta, U(theta) / D(theta)))
    return found


def main():
    rng, count = random.Random(4), 300
    triads = [triad(rng) for _ in range(count)]
    times, counts = [], []
    for legs in triads:
        start = time.perf_counter()
        counts.append(len(flint_modes(legs)))
        times.append(1e6 * (time.perf_counter() - start))
    agree = 0
    for legs, theirs in zip(triads[:50], counts):
        with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
            json.dump({"schema": "assur/triad/1", "legs": legs}, file)
            file.flush()
            report = subprocess.run(["target/release/assur", "triad", file.name, "--certify", "--json"], capture_output=True, text=True, check=True)
        agree += len(json.loads(report.stdout)["modes"]) == theirs
    print(f"python-flint {ctx.prec} bits: median {statistics.median(times):.0f} us over {count} triads, {sum(counts)} real modes; counts agree in {agree} of 50")
    sys.stdout.flush()
    subprocess.run(["cargo", "bench", "--bench", "certify", "--", "--quick"], check=True)


if __name__ == "__main__":
    main()
