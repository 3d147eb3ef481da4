"""Results drawn with matplotlib. Nothing is solved here, and nothing is shown: every function returns the axes it drew into.

Filled circles are actuated joints, open ones passive; thick lines are sliders; the filled shape is the platform.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .groups import CouplerCurve, GroupAssemblies, LinkageAssemblies
from .hana import ArcRegion, HanaTilts
from .loci import SingularityLoci
from .manipulator import Manipulator
from .modes import AssemblyModes, Mode, ModesBatch
from .motion import WorkingModes
from .paths import FollowedPath
from .sweeps import Sweep
from .tripod import DeterminantCurves, TiltMap
from .workspaces import Isolated, Overlay, POINTS, Region

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes

#: Colours of modes: Okabe and Ito's, told apart in all kinds of colour vision; brown for their yellow, which is lost on white.
COLOURS = ("#d55e00", "#0072b2", "#009e73", "#e69f00", "#cc79a7", "#56b4e9", "#7a4a21", "#000000")
#: Assemblies drawn over one another, at most; more cannot be told apart.
MOST_OVERLAID = 8

#: Limits named in a legend, at most; more are a wall of text.
MOST_NAMED = 12

Points = NDArray[np.float64]


def _axes(ax: Axes | None, *, equal: bool = True) -> Axes:
    if ax is None:
        import matplotlib.pyplot

        _, ax = matplotlib.pyplot.subplots(layout="constrained")
    if equal:
        # With the box kept, shared axes stay possible.
        ax.set_aspect("equal", adjustable="datalim")
        ax.set_xlabel("x")
        ax.set_ylabel("y")
    return ax


def _window(ax: Axes, low: Points, high: Points) -> None:
    """Exactly this part of the plane: the box gives way, not the limits."""
    ax.set_aspect("equal", adjustable="box")
    ax.set_xlim(low[0], high[0])
    ax.set_ylim(low[1], high[1])


def _colour(place: int) -> str:
    return COLOURS[place % len(COLOURS)]


# --- mechanisms ----------------------------------------------------------------------------------------------------------------------


def _chains(ax: Axes, robot: Manipulator, joints: Points, colour: str, label: str | None = None) -> None:
    """Legs and platform for given joint values."""
    frames = robot.frames(joints)
    kinds = [leg["joints"].replace("_", "") for leg in robot.check()["legs"]]
    for leg, (chain, kind, actuated) in enumerate(zip(frames, kinds, robot._actuated(), strict=True)):
        line = chain[:, :, :2].reshape(-1, 2)
        ax.plot(line[:, 0], line[:, 1], color=colour, lw=1.4, label=label if leg == 0 else None, zorder=2)
        for joint in range(3):
            before, after = chain[joint, :, :2]
            if kind[joint] == "P":
                ax.plot(*zip(before, after, strict=True), color=colour, lw=3.5, alpha=0.45, solid_capstyle="butt", zorder=1)
            face = colour if actuated[joint] else "white"
            marker = "s" if kind[joint] == "P" else "o"
            at = after if kind[joint] == "P" else before
            ax.plot(*at, marker, mfc=face, mec=colour, ms=5, zorder=3)
    _platform(ax, frames[:, 2, 1, :2], colour)
    bases = frames[:, 0, 0, :2]
    ax.plot(bases[:, 0], bases[:, 1], "^", color="#555555", ms=8, zorder=0)


def _platform(ax: Axes, corners: Points, colour: str) -> None:
    ax.fill(corners[:, 0], corners[:, 1], color=colour, alpha=0.18, lw=0, zorder=1)
    closed = np.vstack([corners, corners[:1]])
    ax.plot(closed[:, 0], closed[:, 1], color=colour, lw=1.2, zorder=2)


def _triad_mode(ax: Axes, triad: dict[str, Any], mode: Mode, colour: str, label: str | None) -> None:
    """A triad has no joints: its platform points, and where they are held."""
    x, y, phi = mode.pose
    turn = np.array([[np.cos(phi), -np.sin(phi)], [np.sin(phi), np.cos(phi)]])
    corners = []
    for place, leg in enumerate(triad["legs"]):
        if "b" not in leg:
            continue
        corner = np.array([x, y]) + turn @ np.array(leg["b"])
        corners.append(corner)
        base = np.array(leg["a"])
        style = "-" if leg["type"] == "RR" else ":"
        ax.plot(*zip(base, corner, strict=True), style, color=colour, lw=1.4, label=label if place == 0 else None)
        ax.plot(*base, "^", color="#555555", ms=8)
        ax.plot(*corner, "o", mfc="white", mec=colour, ms=5)
    if corners:
        _platform(ax, np.array(corners), colour)


def _mode(ax: Axes, answer: AssemblyModes, place: int) -> None:
    mode, colour = answer.modes[place], _colour(place)
    label = f"{place + 1}" if mode.signs is None else f"{place + 1}  {mode.signs}"
    if mode.joints is not None and answer._origin is not None:
        _chains(ax, answer._origin, mode.joints, colour, label)
    elif answer.triad is not None:
        _triad_mode(ax, answer.triad, mode, colour, label)


def modes(answer: AssemblyModes, ax: Axes | None) -> Axes:
    """All assembly modes over one another."""
    ax = _axes(ax)
    for place in range(len(answer)):
        _mode(ax, answer, place)
    ax.set_title(f"{answer.status}; {answer.account}")
    if answer.modes:
        ax.legend(title="mode", fontsize="small")
    return ax


def each_mode(answer: AssemblyModes) -> NDArray[np.object_]:
    """Each assembly mode in axes of its own."""
    import matplotlib.pyplot

    count = max(len(answer), 1)
    columns = min(3, count)
    rows = -(-count // columns)
    figure, grid = matplotlib.pyplot.subplots(
        rows, columns, squeeze=False, sharex=True, sharey=True, layout="constrained", figsize=(3.2 * columns, 3.2 * rows)
    )
    all_axes: NDArray[np.object_] = np.array(grid, dtype=object).ravel()
    for place, ax in enumerate(all_axes):
        ax.set_aspect("equal", adjustable="box")
        if place >= len(answer):
            ax.set_visible(False)
            continue
        _mode(ax, answer, place)
        found = answer.modes[place]
        ax.set_title(f"{place + 1}   {found.signs or ''}   φ = {np.degrees(found.pose[2]):.2f}°", fontsize="small")
    figure.suptitle(f"{answer.status}; {answer.account}")
    return all_axes[: len(answer)]


def working_modes(answer: WorkingModes, ax: Axes | None) -> Axes:
    """All working modes over one another."""
    ax = _axes(ax)
    for place, mode in enumerate(answer.modes):
        _chains(ax, answer._origin, mode.joints, _colour(place), mode.signs)
    if answer.modes:
        ax.legend(title="mode", fontsize="small")
    ax.set_title(answer._summary())
    return ax


def batch(answer: ModesBatch, ax: Axes | None) -> Axes:
    """Positions of all modes of all rows, coloured by orientation."""
    ax = _axes(ax)
    x, y, phi = answer._poses[~answer.mask].T
    dots = ax.scatter(x, y, c=phi, cmap="twilight", vmin=-np.pi, vmax=np.pi, s=4, lw=0)
    ax.figure.colorbar(dots, ax=ax, label="φ (rad)")
    ax.set_title(f"{len(x)} modes of {len(answer)} rows")
    return ax


# --- the plane -----------------------------------------------------------------------------------------------------------------------


def loci(answer: SingularityLoci, ax: Axes | None) -> Axes:
    """Singular curves over the map, if there is one."""
    from matplotlib.collections import LineCollection

    ax = _axes(ax)
    pieces = [mode.pieces.reshape(-1, 2, 2) for mode in answer.type_2.modes]
    ends = np.concatenate([piece.reshape(-1, 2) for piece in pieces]) if pieces else np.empty((0, 2))
    if answer.map is not None:
        low, high = answer.map.low, answer.map.high
        image = ax.imshow(
            answer.map.grid, origin="lower", extent=(low[0], high[0], low[1], high[1]), cmap="viridis", interpolation="nearest"
        )
        ax.figure.colorbar(image, ax=ax, label=f"{answer.map.quantity}, mode {answer.map.signs}")
    elif len(ends):
        low, high = ends.min(axis=0), ends.max(axis=0)
        room = 0.06 * max(high - low)
        low, high = low - room, high + room
    else:
        low, high = np.array([-1.0, -1.0]), np.array([1.0, 1.0])
    for leg in answer.type_1:
        for curve in leg.curves:
            if curve.center is not None and curve.radius is not None:
                turn = np.linspace(0.0, 2.0 * np.pi, 257)
                x, y = curve.center[:, np.newaxis] + curve.radius * np.array([np.cos(turn), np.sin(turn)])
                ax.plot(x, y, color="#8a949e", lw=1.0, zorder=2)
            elif curve.point is not None and curve.direction is not None:
                ax.axline(tuple(curve.point), tuple(curve.point + curve.direction), color="#8a949e", lw=1.0, zorder=2)
    drawn = {mode.signs: piece for mode, piece in zip(answer.type_2.modes, pieces, strict=True) if len(piece)}
    if len(drawn) > 1 and all(np.array_equal(piece, pieces[0]) for piece in pieces):
        drawn = {"all": pieces[0]}
    for place, (signs, piece) in enumerate(drawn.items()):
        lines = LineCollection(list(piece), colors=_colour(place), linewidths=1.6, label=signs, zorder=3)
        ax.add_collection(lines)
    if drawn:
        ax.legend(title="type 2, mode", fontsize="small")
    _window(ax, low, high)
    ax.set_title(f"singular positions, φ = {answer.phi:.6g} rad")
    return ax


def path(answer: FollowedPath, ax: Axes | None) -> Axes:
    """Positions along a path with its events."""
    ax = _axes(ax)
    poses = answer.poses
    ax.plot(poses[:, 0], poses[:, 1], "-", color=COLOURS[1], lw=1.4)
    if len(poses):
        ax.plot(*poses[0, :2], "o", color=COLOURS[1], label="start")
        ax.plot(*poses[-1, :2], "s", color=COLOURS[1], label="end" if answer.complete else "stop")
    for kind in dict.fromkeys(event.kind for event in answer.events):
        at = np.array([event.pose[:2] for event in answer.events if event.kind == kind])
        ax.plot(at[:, 0], at[:, 1], "X", color=COLOURS[0], ms=8, ls="none", label=kind)
    ax.legend(fontsize="small")
    ax.set_title(answer._summary())
    return ax


def animate(answer: FollowedPath, ax: Axes | None, *, frames: int, interval: float) -> FuncAnimation:
    """The mechanism along a path."""
    from matplotlib.animation import FuncAnimation

    robot: Manipulator = answer._origin
    chosen = np.unique(np.linspace(0, len(answer.rows) - 1, max(frames, 1)).round().astype(int))
    # The joints of a row's pose: the working mode whose actuated joints are the row's inputs.
    joints = [_joints_at(robot, answer.rows[place].pose, answer.rows[place].inputs) for place in chosen]
    ax = _axes(ax)
    ends = np.concatenate([robot.frames(values)[:, :, :, :2].reshape(-1, 2) for values in joints])
    low, high = ends.min(axis=0), ends.max(axis=0)
    room = 0.08 * max(high - low)

    def draw(frame: int) -> list[Any]:
        ax.clear()
        _axes(ax)
        ax.plot(answer.poses[:, 0], answer.poses[:, 1], "-", color="#8a949e", lw=1.0)
        _chains(ax, robot, joints[frame], COLOURS[1])
        _window(ax, low - room, high + room)
        ax.set_title(f"row {answer.rows[chosen[frame]].step}")
        return list(ax.get_children())

    return FuncAnimation(ax.figure, draw, frames=len(joints), interval=interval, blit=False)  # type: ignore[arg-type]


def _joints_at(robot: Manipulator, pose: Points, inputs: Points) -> Points:
    actuated = robot._actuated()

    def off(joints: Points) -> float:
        values = joints[actuated]
        # Angles count modulo a turn.
        return float(np.min([np.abs(values - inputs), np.abs(np.exp(1j * values) - np.exp(1j * inputs))], axis=0).sum())

    return min((mode.joints for mode in robot.inverse(pose)), key=off)


# --- groups --------------------------------------------------------------------------------------------------------------------------


def _links(ax: Axes, corners: dict[int, list[Points]], ground: int, colour: str, label: str | None) -> None:
    for link, points in corners.items():
        shape = np.array(points)
        if link == ground:
            ax.plot(shape[:, 0], shape[:, 1], "^", color="#555555", ms=8)
            continue
        order = np.argsort(np.arctan2(*(shape - shape.mean(axis=0)).T[::-1]))
        ax.fill(*shape[order].T, color=colour, alpha=0.15, lw=0)
        ring = np.append(order, order[0])
        ax.plot(*shape[ring].T, "-", color=colour, lw=1.3, label=label)
        ax.plot(*shape.T, "o", mfc="white", mec=colour, ms=4)
        label = None


def _placed(joints: list[tuple[int, int, complex]], motions: dict[int, tuple[complex, complex]]) -> dict[int, list[Points]]:
    corners: dict[int, list[Points]] = {}
    for first, second, at in joints:
        for link in (first, second):
            origin, turn = motions[link]
            found = origin + turn * at
            corners.setdefault(link, []).append(np.array([found.real, found.imag]))
    return corners


def _walked(joints: list[tuple[int, int, complex]], turns: dict[int, complex], ground: int) -> dict[int, tuple[complex, complex]]:
    """Where links are, from how they are turned: joint by joint away from the ground."""
    motions = {ground: (0j, 1.0 + 0j)}
    while len(motions) < len(turns):
        for first, second, at in joints:
            for known, other in ((first, second), (second, first)):
                if known in motions and other not in motions:
                    origin, turn = motions[known]
                    motions[other] = (origin + turn * at - turns[other] * at, turns[other])
    return motions


def trusses(answer: GroupAssemblies, ax: Axes | None) -> Axes:
    """Real assemblies over one another."""
    problem = answer._origin.document()
    ground = int(problem.get("ground", 0))
    joints = [(i, j, complex(*at)) for (i, j), at in zip(problem["edges"], problem["joint_xy"], strict=True)]
    others = [link for link in range(problem["links"]) if link != ground]
    real = [assembly for assembly in answer.assemblies if assembly.real]

    def shapes() -> Iterable[tuple[str, dict[int, list[Points]]]]:
        for place, assembly in enumerate(real, 1):
            turns = {ground: 1.0 + 0j, **dict(zip(others, map(complex, assembly.theta), strict=True))}
            yield str(place), _placed(joints, _walked(joints, turns, ground))

    return _overlaid(ax, shapes(), ground, answer._title(), answer._summary())


def linkages(answer: LinkageAssemblies, ax: Axes | None) -> Axes:
    """Assemblies of a linkage over one another."""
    problem = answer._origin.document()
    ground = int(problem.get("ground", 0))
    joints = [(*joint["links"], complex(*joint["at"])) for joint in problem["joints"]]

    def shapes() -> Iterable[tuple[str, dict[int, list[Points]]]]:
        for assembly in answer.assemblies:
            motions = {link: (complex(x, y), np.exp(1j * phi)) for link, (x, y, phi) in enumerate(assembly.poses)}
            yield "-".join(map(str, assembly.choice)), _placed(joints, motions)

    return _overlaid(ax, shapes(), ground, answer._title(), answer._summary())


def _overlaid(
    ax: Axes | None, shapes: Iterable[tuple[str, dict[int, list[Points]]]], ground: int, title: str, summary: str
) -> Axes:
    ax = _axes(ax)
    drawn = 0
    for place, (label, corners) in zip(range(MOST_OVERLAID), shapes, strict=False):
        _links(ax, corners, ground, _colour(place), label)
        drawn += 1
    if drawn:
        ax.legend(title="assembly", fontsize="small")
    ax.set_title(f"{title}\n{summary}", fontsize="medium")
    return ax


def coupler(answer: CouplerCurve, ax: Axes | None) -> Axes:
    """The curve with its foci, double points and intersections."""
    ax = _axes(ax)
    for place, piece in enumerate(answer.polygons()):
        closed = np.vstack([piece, piece[:1]])
        ax.plot(*closed.T, color=_colour(1 + place), lw=1.5, label=f"circuit {place + 1}")
    if answer.foci.size:
        ax.plot(*answer.foci.T, "x", color="#555555", label="foci")
    double = [point.point for point in answer.double_points or () if point.point is not None]
    if double:
        ax.plot(*np.array(double).T, "D", mfc="white", mec="black", ms=5, label="double points")
    if len(answer.points):
        ax.plot(*answer.points.T, "o", color=COLOURS[0], ms=6, label="intersections")
    ax.legend(fontsize="small")
    ax.set_title(answer._summary(), fontsize="medium")
    return ax


def _filled(ax: Axes, outlines: list[Points], colour: str) -> None:
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    closed = [line for line in outlines if len(line) > 2]
    if closed:
        # One path: holes run the other way round and stay empty.
        whole = Path.make_compound_path(*(Path(line, closed=True) for line in closed))
        ax.add_patch(PathPatch(whole, fc=colour, alpha=0.15, lw=0))


def region(answer: Region, ax: Axes | None, label: str | None) -> Axes:
    """A workspace: filled, its boundary coloured by the limit that is active there, or in one colour among others."""
    ax = _axes(ax)
    outlines = answer.outlines()
    if answer.overlays:
        # Over one another each is in one colour under its name.
        isolated = _outlined(ax, outlines, label or answer.kind, answer)
        for other, others in zip(answer.overlays, answer.overlay_outlines(), strict=True):
            colour = _outlined(ax, others, other._label(), other)
            for part in other.isolated:
                _isolated(ax, part, colour)
    elif label is None:
        _filled(ax, outlines, COLOURS[1])
        _by_limit(ax, answer, outlines)
        isolated = COLOURS[0]
        ax.set_title(f"{answer.kind}: " + (f"area {answer.area:.8g}" if answer.components else answer._without_area()))
        if not outlines and not answer.isolated:
            # Axes without data have a scale that means nothing.
            ax.set(xticks=[], yticks=[])
            ax.text(0.5, 0.5, answer._without_area(), transform=ax.transAxes, ha="center", va="center", color="#8a949e")
    else:
        isolated = _outlined(ax, outlines, label, answer)
    for part in answer.isolated:
        _isolated(ax, part, isolated)
    ax.autoscale_view()
    return ax


def _isolated(ax: Axes, part: Isolated, colour: str) -> None:
    """A point, an arc or a segment without area; of other curves the ends."""
    if part.at is not None:
        ax.plot(*part.at, ".", color=colour)
    elif part.center is not None and part.radius is not None and part.start_angle is not None and part.end_angle is not None:
        turn = np.linspace(part.start_angle, part.end_angle, POINTS)
        ax.plot(part.center[0] + part.radius * np.cos(turn), part.center[1] + part.radius * np.sin(turn), color=colour, lw=1.6)
    elif part.start is not None and part.end is not None:
        ends = np.array([part.start, part.end])
        ax.plot(*ends.T, "-" if part.curve == "line" else ".", color=colour, lw=1.6)


def _outlined(ax: Axes, outlines: list[Points], label: str, region: Region | Overlay) -> str:
    """A region among others: filled and bounded in the next colour, which is returned, under its name."""
    colour = _colour(len(ax.get_legend_handles_labels()[1]))
    _filled(ax, outlines, colour)
    for place, line in enumerate(outlines):
        ax.plot(*line.T, color=colour, lw=1.6, label=None if place else label)
    if not outlines:
        ax.plot([], [], color=colour, lw=1.6, label=f"{label} ({region._without_area()})")
    ax.legend(fontsize="small")
    return colour


def _by_limit(ax: Axes, answer: Region, outlines: list[Points]) -> None:
    names = list(dict.fromkeys(", ".join(arc.active) for loop in answer.loops for arc in loop.arcs))
    labelled: set[str] = set()
    for loop, line in zip(answer.loops, outlines, strict=True):
        begin = 0
        for arc in loop.arcs:
            count = (2 if arc.curve == "line" else POINTS) - 1
            piece = line[begin : begin + count + 1]
            begin += count
            name = ", ".join(arc.active)
            ax.plot(*piece.T, color=_colour(names.index(name)), lw=1.6, label=None if name in labelled else name)
            labelled.add(name)
    for flat in answer._shape.separating(POINTS):
        ax.plot(*np.asarray(flat).reshape(-1, 2).T, color="#8a949e", lw=0.8, ls="--")
    if 0 < len(names) <= MOST_NAMED:
        ax.legend(fontsize="x-small")


def slices(answer: Region, ax: Axes | None) -> Axes:
    """The slices of a stack in space, orientation upwards."""
    if ax is None:
        import matplotlib.pyplot

        ax = matplotlib.pyplot.figure(layout="constrained").add_subplot(projection="3d")
    space: Any = ax
    stack = answer.stack
    for one, outlines in zip(stack.slices if stack else (), answer.slice_outlines(), strict=True):
        for line in outlines:
            space.plot(*line.T, one.phi, color=COLOURS[1], lw=1.0)
    space.set(xlabel="x", ylabel="y", zlabel="φ (rad)")
    if stack is not None:
        space.set_title(f"volume {stack.volume:.8g}")
    return ax


# --- spatial robots ------------------------------------------------------------------------------------------------------------------


def arcs(answer: ArcRegion, ax: Axes | None) -> Axes:
    """A workspace of HANA."""
    ax = _axes(ax)
    ax.set_xlabel("y")
    ax.set_ylabel("z")
    for loop, pieces in zip(answer.loops, answer.outlines(), strict=True):
        colour = COLOURS[1] if loop.area > 0 else "white"
        ax.fill(*np.concatenate(pieces).T, color=colour, alpha=0.18 if loop.area > 0 else 1.0, lw=0)
        for piece in pieces:
            ax.plot(*piece.T, color=COLOURS[1], lw=1.5)
    ax.set_title(f"{answer.kind}: area {answer.area:.6f}")
    return ax


def tilts(answer: HanaTilts, ax: Axes | None) -> Axes:
    """The rotational capability over the workspace."""
    ax = _axes(ax)
    ax.set_xlabel("y")
    ax.set_ylabel("z")
    if answer.map is not None:
        left, bottom, right, top = answer.map.window
        image = ax.imshow(
            np.degrees(answer.map.grid), origin="lower", extent=(left, right, bottom, top), cmap="viridis", interpolation="nearest"
        )
        ax.figure.colorbar(image, ax=ax, label="rotational capability (°)")
        # The cells are as coarse as they are; the boundary is exact.
        robot, mode = answer._origin
        for piece in itertools.chain.from_iterable(robot.workspace("constant", phi=0.0, mode=mode).outlines()):
            ax.plot(*piece.T, color="black", lw=1.0)
    said = []
    if answer.at is not None and answer.zeta is not None:
        ax.plot(*answer.at, "o", mfc="white", mec="black")
        said.append(f"{np.degrees(answer.zeta):.6g}° at ({', '.join(f'{x:.6g}' for x in answer.at)})")
    if answer.supremum is not None:
        said.append(f"largest {np.degrees(answer.supremum.zeta):.6g}°")
    ax.set_title(", ".join(said) or "empty workspace")
    return ax


def tilt_section(answer: TiltMap, section: int, ax: Axes | None) -> Axes:
    """One section of a tilt map, in the scale of all of them."""
    ax = _axes(ax)
    low, high = answer.low, answer.high
    degrees = np.degrees(answer.grid)
    known = degrees[np.isfinite(degrees)]
    image = ax.imshow(
        degrees[section],
        origin="lower",
        extent=(low[0], high[0], low[1], high[1]),
        cmap="viridis",
        vmin=0.0,
        vmax=float(known.max()) if known.size else 1.0,
    )
    ax.figure.colorbar(image, ax=ax, label="largest tilt (°)")
    ax.set_title(f"z = {answer.sections[section].z:.6g}")
    return ax


def determinants(answer: DeterminantCurves, ax: Axes | None) -> Axes:
    """det J over the elevations of a design."""
    ax = _axes(ax, equal=False)
    for place, values in enumerate(answer.determinants):
        ax.plot(np.degrees(answer.elevations), values, color=_colour(place), lw=1.4, label=f"pose {place + 1}")
    ax.axhline(0.0, color="#8a949e", lw=0.8)
    ax.set(xlabel="elevation (°)", ylabel="det J")
    ax.legend(fontsize="small")
    ax.set_title(answer._title())
    return ax


# --- sweeps --------------------------------------------------------------------------------------------------------------------------


def sweep(answer: Sweep, x: str, y: str, ax: Axes | None, front: NDArray[np.int64] | None) -> Axes:
    """Two columns of a sweep against each other."""
    ax = _axes(ax, equal=False)
    ax.plot(answer[x], answer[y], ".", color="#8a949e", ms=4, label="designs")
    if front is not None:
        order: Sequence[int] = sorted(front, key=lambda row: float(answer[x][row]))
        ax.plot(answer[x][order], answer[y][order], "o-", color=COLOURS[0], ms=5, lw=1.2, label="no design is better in both")
        ax.legend(fontsize="small")
    ax.set_xlabel(x)
    ax.set_ylabel(y)
    return ax
