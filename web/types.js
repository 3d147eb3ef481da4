// What the server's answers look like. Angles in radians, lengths those of the model, points in the base frame.

/**
 * @typedef {[number, number]} Point
 * @typedef {[number, number, number]} Pose x, y, phi
 * @typedef {{ actuated: boolean, violated: boolean }} Look
 * @typedef {{ mark: "body"|"rail"|"ground"|"number"|"bar"|"telescope"|"block"|"pin"|"frame", at: Point[], along?: Point, fixed?: boolean, leg?: number, look?: Look }} Mark
 * @typedef {{ pose: Pose, multiplicity: number, residual: number, proof: string, signs: string | null, det_a: number, violations: { leg: number, joint: number }[] }} Mode
 * @typedef {{ degree: number, real: number, complex: number, at_infinity: number, rejected: number, self_motion: number, undecided: number }} Account
 * @typedef {{ theta: Point, multiplicity: number }} ComplexMode
 * @typedef {{ status: string, inputs: number[], group: string | null, modes: Mode[], complex: ComplexMode[], account: Account, special: string[], certificate?: { summary: string, complete: boolean, about: string } }} ForwardReport
 * @typedef {{ handle: string, leg?: number, at: Point, origin?: Point, from?: Point }} Handle
 * @typedef {{ leg: number, joint: number, angle: boolean, limited: boolean, range: Point }} Actuator
 * @typedef {{ kind: "meeting"|"branch"|"self_motion"|"lost"|"crossing"|"stopped", pose: Pose }} Event_
 * @typedef {{ schema: string, name?: string, angle_unit?: string, leg: unknown[] }} Model
 * @typedef {{ pose: Pose, signs: string }} Held
 * @typedef {{ curve?: string, points: Point[] }} Arc
 * @typedef {{ kind: string, area: number, perimeter: number, components: number, holes: number, unclosed: number, micros: number, loops: Point[][], separating: Point[][], isolated: Point[] }} Region
 * @typedef {{
 *   model: Model, family: string, inputs: number[], report: ForwardReport, came_from: (number | null)[], ended: Pose[], drawings: Mark[][],
 *   current: number | null, event: Event_ | null, handles: Handle[], actuators: Actuator[], size: number, workspace?: Region | { error: string } | null
 * }} Moved
 * @typedef {{ pair: Point, low: Point, high: Point, size: Point, counts: string }} ActuatorPlane
 * @typedef {{ report: { type_2: { modes: { signs: string, pieces: [Point, Point][] }[] } }, type_1: [Point, Point][][] }} Loci
 * @typedef {{ kind: string, from: number, to: number }} WorkspaceWish
 * @typedef {{ page: "manipulator", model: Model, inputs: number[], mode: Held | null, workspace: WorkspaceWish, loci: boolean, pair: Point }} ManipulatorState
 * @typedef {{ page: "four_bar", file: { name?: string }, place: { circuit: number, tau: number } }} FourBarState
 * @typedef {{ page: "truss", file: { name?: string } }} TrussState
 * @typedef {ManipulatorState | FourBarState | TrussState} State
 * @typedef {{
 *   pull?: object | null, key?: string, drag?: boolean, end?: boolean, take?: number, place?: { circuit?: number, tau?: number }, pick?: boolean, book?: boolean, quiet?: boolean
 * }} Wish What a page is to do: `key` names what is pulled, `drag` a step of a drag, `end` its end, `take` a mode by its tone or an assembly by its number, `book` an arrival that undo leads back to
 * @typedef {{ file: { name?: string }, report: { grashof: string | null, foci: Point[], double_points: { kind: string, point: Point | null }[] | null, circuits: object[], cognates: object[] }, circuits: Point[][], place: { circuit: number, tau: number }, pivots: Point[], joints: Point[] | null, point: Point | null, size: number }} FourBarAnswer
 * @typedef {{ file: { name?: string }, report: { status: string, count: number, expected: number | null, missing: number | null, truss: string | null, assemblies: { real: boolean, residual: number }[] }, drawings: Mark[][], current: number | null, joints: Point[], size: number }} TrussAnswer
 */

export {};
