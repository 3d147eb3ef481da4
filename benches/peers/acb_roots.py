"""Proved assembly modes of random RR-RR-RR triads: python-flint beside assur, in one run.

    pip install python-flint
    cargo build --release && python3 benches/peers/acb_roots.py

The triads are those of `cargo bench --bench certify`, made by the same generator. FLINT's side: T(theta) as a polynomial of balls, certified roots of the
sextic (acb_poly.roots), which of them lie on the unit circle, back-substitution for u in ball arithmetic. A root whose ball meets the circle is taken to lie on
it, which is no proof; ours counts exactly. Every triad's count is compared with that of `assur triad --certify`; our times are those that the bench prints.
"""
import json, math, statistics, subprocess, sys, tempfile, time
from flint import acb, acb_poly, arb, ctx

ctx.prec = 106
I = acb(0, 1)


def triads(count):
    """As in benches/certify.rs: each planted in a random pose."""
    state = 4

    def number():
        nonlocal state
        state = (state * 6364136223846793005 + 1442695040888963407) % 2**64
        return (state >> 11) / 2**52 - 1

    for _ in range(count):
        x, y, turn = 5 * number(), 5 * number(), math.pi * number()
        legs = []
        for _ in range(3):
            a, b = [[5 * number() for _ in range(2)] for _ in range(2)]
            dx = x + math.cos(turn) * b[0] - math.sin(turn) * b[1] - a[0]
            dy = y + math.sin(turn) * b[0] + math.cos(turn) * b[1] - a[1]
            legs.append({"type": "RR", "a": a, "b": b, "l": math.sqrt(dx * dx + dy * dy)})
        # The shortest leg first, as the reference.
        yield sorted(legs, key=lambda leg: leg["l"])


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


def our_modes(legs):
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump({"schema": "assur/triad/1", "legs": legs}, file)
        file.flush()
        command = ["target/release/assur", "triad", file.name, "--certify", "--json"]
        report = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    assert report["certificate"]["complete"]
    return len(report["modes"])


def main():
    times, theirs, ours = [], [], []
    for legs in triads(1000):
        best = math.inf
        for _ in range(3):
            start = time.perf_counter()
            found = len(flint_modes(legs))
            best = min(best, 1e6 * (time.perf_counter() - start))
        times.append(best)
        theirs.append(found)
        ours.append(our_modes(legs))
    differ = sum(t != o for t, o in zip(theirs, ours))
    print(f"{'':24}{'modes':>8}{'median':>12}{'90 % below':>12}")
    print(f"{f'python-flint, {ctx.prec} bits':24}{sum(theirs):8}{statistics.median(times):9.0f} us{sorted(times)[900]:9.0f} us")
    print(f"{'assur':24}{sum(ours):8}{'see below':>12}")
    print(f"counts differ in {differ} of {len(ours)} triads")
    sys.stdout.flush()
    subprocess.run(["cargo", "bench", "--bench", "certify", "--", "--quick"], check=True)


if __name__ == "__main__":
    main()
