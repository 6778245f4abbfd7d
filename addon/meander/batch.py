# SPDX-License-Identifier: GPL-3.0-or-later
"""The batch command: a mesh file in, a filling curve and a report out, without a window.

    blender --background --python-exit-code 1 --python <this file> -- --input MESH --output OUT ...

It runs from an installed add-on and from a source checkout, inside Blender and under the bpy
module (``python batch.py -- ...``). OBJ in and OBJ out need neither.

Exit codes: 0 done, also when the iteration limit was reached (the report says so); 2 bad input,
with one sentence on stderr and every output file as it was; 1 a defect, with a traceback; 130
interrupted from the keyboard, with every output file as it was.
"""

from __future__ import annotations

import argparse
import importlib.util
import os
import signal
import sys
import time
import traceback
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import bpy


def _containing_package() -> str:
    """The name of the package that this file lies in, imported if need be.

    Blender runs this file as a script, which has no package. When the add-on is enabled its package
    is there already; else it is loaded under a name of its own, so that neither sys.path changes
    nor an add-on of the same name from another folder gets in the way.
    """
    folder = Path(__file__).resolve().parent
    for name, module in list(sys.modules.items()):
        paths = list(getattr(module, "__path__", None) or [])
        if len(paths) == 1 and Path(paths[0]).resolve() == folder:
            return name
    name = "_meander_batch_package"
    spec = importlib.util.spec_from_file_location(
        name, folder / "__init__.py", submodule_search_locations=[str(folder)]
    )
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return name


if not globals().get("__package__"):
    __package__ = _containing_package()  # what relative imports go by (PEP 366)

# The package has to be known first.
from . import (  # noqa: E402
    batch_density,
    batch_motion,
    batch_preparation,
    batch_strands,
    batch_terms,
    batch_toolpath,
    batch_values,
    core,
    mesh_files,
    report,
    strands,
    thinning,
    toolpath,
)
from .alignment import Alignment, Directions  # noqa: E402
from .batch_values import BadInput  # noqa: E402
from .density import Choice, curvature_density  # noqa: E402
from .preparation import Mask, Repair, described, outlined  # noqa: E402
from .stepper import evaluated  # noqa: E402

# A line of progress for every so many iterations, or seconds.
_PROGRESS_ITERATIONS = 10
_PROGRESS_SECONDS = 10.0
# The longest time between two looks at a run, in seconds.
_LONGEST_PAUSE = 0.1


@dataclass
class Problem:
    """A surface to fill, and what the input knows besides; arrays are as core.Flow wants them."""

    vertices: NDArray[np.float64]
    faces: NDArray[np.uint32]
    seed: core.Seed | None = None
    # Per vertex, or what computes it from the surface.
    density: NDArray[np.float64] | Callable[[core.Surface], NDArray[np.float64]] | None = None
    density_choice: Choice = field(default_factory=Choice)  # what the density was made from
    alignment: Alignment = field(default_factory=Alignment)
    directions: Directions | None = None
    repair: Repair = field(default_factory=Repair)
    mask: Mask = field(default_factory=Mask)
    surface_options: core.SurfaceOptions = field(default_factory=core.SurfaceOptions)
    loose_edges: int = 0
    fixed_ends: bool = False
    stroke: tuple[list[float], list[float]] | None = None  # its ends
    parts: list[strands.Part] = field(default_factory=list)  # what the seed is put together from
    surface_object: bpy.types.Object | None = None  # None: the mesh came from an OBJ file


# ------------------------------------------------------------------------------------------------
# The command line


def _parser() -> argparse.ArgumentParser:
    parser = batch_values.Parser(
        prog="batch.py",
        description="Grow a curve on a mesh until it fills the surface at an even spacing.",
        allow_abbrev=False,
    )
    add = parser.add_argument
    add("--input", type=Path, required=True, metavar="MESH", help=".obj, .ply, .stl or .blend")
    add("--object", metavar="NAME", help="mesh object in the .blend; default: the active one")
    add("--output", type=Path, required=True, metavar="OUT", help=".obj, .blend, .csv or .json")
    add("--report", type=Path, metavar="JSON", help="write figures of the run")
    add(
        "--spacing",
        type=batch_values.positive,
        required=True,
        metavar="S",
        help="distance of neighbouring strands, in scene units",
    )
    add("--seed", type=Path, metavar="CURVE", help=".obj with v and l lines, in the mesh's space")
    add(
        "--seed-object",
        metavar="NAME",
        help="curve object in the .blend; its ends stay put if the surface's settings say so",
    )
    add(
        "--segment-length",
        type=batch_values.positive,
        metavar="H",
        help="default: a tenth of the spacing",
    )
    add(
        "--max-radius",
        type=batch_values.positive,
        metavar="RMAX",
        help="limit of the medial radius",
    )
    add("--iterations", type=batch_values.count(1, 2**31 - 1), metavar="N", help="iteration limit")
    add(
        "--medial-axis",
        choices=("euclidean", "geodesic"),
        default="euclidean",
        help="measure distances between strands through space, or along the surface",
    )
    add("--preset", choices=("even", "finest", "paper"), default="even")
    add(
        "--threads",
        type=batch_values.count(0, 256),
        default=0,
        metavar="T",
        help="0: all; same result",
    )
    add("--quiet", action="store_true", help="print nothing but errors")
    batch_density.add_options(parser, batch_values.number)
    batch_terms.add_options(parser, batch_values.not_negative)
    batch_strands.add_options(parser, batch_values.number, batch_values.count(0, 2**31 - 1))
    batch_preparation.add_options(parser, batch_values.number)
    batch_toolpath.add_options(parser, batch_values.positive)
    batch_motion.add_options(parser, batch_values.count(1, 1000))
    return parser


def _arguments_of_process() -> list[str]:
    """What stands behind ``--``; inside Blender all the rest is Blender's own."""
    if "--" in sys.argv:
        return sys.argv[sys.argv.index("--") + 1 :]
    loaded_bpy = sys.modules.get("bpy")
    if loaded_bpy is not None and loaded_bpy.app.binary_path:
        return []
    return sys.argv[1:]


def _check_arguments(arguments: argparse.Namespace) -> None:
    """Refuses what can be refused before any file is read."""
    kind = arguments.input.suffix.lower()
    if kind not in (".obj", ".ply", ".stl", ".blend"):
        raise BadInput(f"--input {arguments.input} is no .obj, .ply, .stl or .blend file")
    if not arguments.input.is_file():
        raise BadInput(f"--input {arguments.input} does not exist; check the path")
    if kind != ".blend":
        for option in ("object", "seed_object", "guides_object"):
            if getattr(arguments, option) is not None:
                name = option.replace("_", "-")
                raise BadInput(f"--{name} names an object of a .blend, but --input is {kind}")
    for part in (batch_density, batch_preparation, batch_terms, batch_motion):
        wrong = part.problem_of(arguments, kind)
        if wrong is not None:
            raise BadInput(wrong)
    if arguments.seed is not None and arguments.seed_object is not None:
        raise BadInput("--seed and --seed-object are both given; choose one")
    strand_problem = batch_strands.problem_of(arguments)
    if strand_problem is not None:
        raise BadInput(strand_problem)
    if arguments.output.suffix.lower() not in (".obj", ".blend", ".csv", ".json"):
        raise BadInput(f"--output {arguments.output} is no .obj, .blend, .csv or .json file")
    toolpath_problem = batch_toolpath.problem_of(arguments)
    if toolpath_problem is not None:
        raise BadInput(toolpath_problem)
    _check_outputs(arguments)


def _check_outputs(arguments: argparse.Namespace) -> None:
    taken = {"--input": arguments.input, "--seed": arguments.seed, "--guides": arguments.guides}
    for option, path in (("--output", arguments.output), ("--report", arguments.report)):
        if path is None:
            continue
        if path.is_dir() or not path.name:
            raise BadInput(f"{option} {path} is a folder; give a file name")
        if not path.absolute().parent.is_dir():
            raise BadInput(f"the folder of {option} {path} does not exist; make it first")
        if not os.access(path.absolute().parent, os.W_OK):
            raise BadInput(f"the folder of {option} {path} cannot be written to; choose another")
        for other, other_path in taken.items():
            # A scene may be saved over itself: it still holds all that was in it.
            scene = option == "--output" and other == "--input" and path.suffix == ".blend"
            if other_path is not None and path.resolve() == other_path.resolve() and not scene:
                raise BadInput(f"{option} would overwrite {other} {path}; choose another name")
        taken[option] = path


def _flow_options(arguments: argparse.Namespace) -> core.FlowOptions:
    """The preset's options with what the command line says in their place."""
    options = core.default_options(arguments.preset)
    options.radius = arguments.spacing / 2
    options.threads = arguments.threads
    options.medial_axis = core.MedialAxis[arguments.medial_axis.upper()]
    if arguments.border_distance is not None:
        options.border_distance = arguments.border_distance
    if arguments.iterations is not None:
        options.iteration_limit = arguments.iterations
    batch_terms.terms_of(arguments).apply(options)
    if arguments.segment_length is not None:
        options.segment_length = arguments.segment_length  # to the last bit
    if arguments.max_radius is not None:
        options.max_radius = arguments.max_radius
    return options


def _echo(
    arguments: argparse.Namespace, options: core.FlowOptions, problem: Problem
) -> dict[str, Any]:
    """Every option in effect, for the report; null: the preset's own value."""
    echo: dict[str, Any] = {
        "input": str(arguments.input),
        "object": None if problem.surface_object is None else problem.surface_object.name,
        "output": str(arguments.output),
        **batch_toolpath.echo(arguments),
        "seed": None if arguments.seed is None else str(arguments.seed),
        "seed_object": arguments.seed_object,
        "fixed_ends": problem.fixed_ends,
        **batch_strands.echo(arguments, problem.stroke),
        "spacing": arguments.spacing,
        **batch_density.echo(arguments, problem.density_choice),
        **batch_preparation.echo(problem.repair, problem.mask),
        "outline": arguments.outline,
        **batch_terms.echo(arguments, options),
        **batch_motion.echo(arguments),
    }
    echo.update(asdict(options))
    echo["medial_axis"] = arguments.medial_axis
    if options.segment_length == 0:
        echo["segment_length"] = 0.2 * options.radius  # what 0 stands for in the C API
    if options.max_radius == 0:
        echo["max_radius"] = None
    return echo


# ------------------------------------------------------------------------------------------------
# Input


def _read_problem(arguments: argparse.Namespace) -> Problem:
    kind = arguments.input.suffix.lower()
    if kind == ".obj":
        problem = Problem(*mesh_files.read_obj_mesh(arguments.input))
    else:
        _need_bpy(arguments.input)
        from . import blender_data

        try:
            problem = _read_scene(arguments) if kind == ".blend" else _import_mesh(arguments.input)
        except blender_data.DataError as refusal:
            raise BadInput(str(refusal)) from refusal
    if kind != ".blend":
        _set_fields(problem, arguments)
    problem.repair = batch_preparation.repair_of(arguments)
    if problem.mask.source == "NONE":
        problem.surface_options = core.SurfaceOptions(**asdict(problem.repair))
    if arguments.seed is not None:
        seed = mesh_files.read_obj_curve(arguments.seed)
        problem.parts.insert(0, strands.Part(str(arguments.seed), seed))
    problem.stroke = batch_strands.stroke_of(arguments, problem.vertices)
    if isinstance(problem.stroke, str):
        raise BadInput(problem.stroke)
    if problem.stroke is not None:
        problem.parts.insert(0, strands.Part("the stroke", strands.stroke(*problem.stroke)))
    if arguments.guides is not None:
        guides = mesh_files.read_obj_curve(arguments.guides)
        problem.parts.append(strands.Part(str(arguments.guides), guides, guide=True))
    problem.seed = strands.assembled(problem.parts, arguments.fill_every_part)
    return problem


def _set_fields(problem: Problem, arguments: argparse.Namespace) -> None:
    """Density and directions of a mesh from a file of its own: what can be computed on it."""
    radius = arguments.spacing / 2
    problem.density_choice = batch_density.choice_of(arguments, Choice())
    if problem.density_choice.source == "CURVATURE":
        problem.density = curvature_density(problem.density_choice, radius)
    problem.alignment = batch_terms.alignment_of(arguments)
    problem.directions = batch_terms.directions_without_a_scene(
        problem.alignment, len(problem.vertices), radius
    )


def _need_bpy(path: Path) -> None:
    if importlib.util.find_spec("bpy") is None:
        raise BadInput(f"{path} needs Blender; run this command with blender --background --python")


def _refuse_points(points: str | None) -> None:
    from . import blender_data, point_attributes

    try:
        point_attributes.refuse((points or "none").upper())
    except blender_data.DataError as refusal:
        raise BadInput(f"--points {points} is not possible here: {refusal}") from refusal


def _empty_scene() -> None:
    import bpy

    # read_factory_settings would take installed add-ons out of the session.
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)


def _import_mesh(path: Path) -> Problem:
    """Reads a PLY or STL file with Blender's importer, axes and scale left alone."""
    import bpy

    from . import blender_data

    _empty_scene()
    kind = path.suffix.lower()[1:]
    try:
        with _stderr_to_stdout():
            # Importers in C++ replaced the add-ons one by one: in 3.4 there is one for STL only.
            if f"{kind}_import" in dir(bpy.ops.wm):
                operator = getattr(bpy.ops.wm, f"{kind}_import")
                operator(filepath=str(path), forward_axis="Y", up_axis="Z", global_scale=1.0)
            else:
                import addon_utils

                addon_utils.enable(f"io_mesh_{kind}")
                operator = getattr(bpy.ops.import_mesh, kind)
                # STL has an option for axes, and PLY takes them as they are.
                axes = {"axis_forward": "Y", "axis_up": "Z"} if kind == "stl" else {}
                operator(filepath=str(path), **axes)
    except RuntimeError as problem:
        raise BadInput(
            f"{path} cannot be read as {kind.upper()}; export it again or give an .obj file"
        ) from problem
    meshes = [item for item in bpy.context.scene.objects if item.type == "MESH"]
    if len(meshes) != 1:
        raise BadInput(
            f"{path} cannot be read as {kind.upper()}; export it again or give an .obj file"
        )
    depsgraph = bpy.context.evaluated_depsgraph_get()
    vertices, faces = blender_data.triangles_of(meshes[0], depsgraph)
    return Problem(vertices, faces, surface_object=meshes[0])


@contextmanager
def _stderr_to_stdout() -> Iterator[None]:
    """Importers print their complaints from C; stderr is for the one sentence that follows."""
    sys.stderr.flush()
    kept = os.dup(2)
    os.dup2(1, 2)
    try:
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)


def _read_scene(arguments: argparse.Namespace) -> Problem:
    """Opens a .blend and takes surface, seed and density from its objects, in world units."""
    import bpy

    from . import blender_alignment, blender_data, blender_density, blender_preparation

    try:
        bpy.ops.wm.open_mainfile(filepath=str(arguments.input.absolute()), load_ui=False)
    except RuntimeError as problem:
        raise BadInput(
            f"{arguments.input} is no .blend file that Blender {bpy.app.version_string} can open; "
            "save it again with this version or an older one"
        ) from problem
    surface_object = _mesh_object(arguments)
    with _saved_settings():
        settings = surface_object.meander
        choice = batch_density.choice_of(arguments, blender_density.choice_of(settings))
        fixed_ends = settings.fixed_ends
    depsgraph = bpy.context.evaluated_depsgraph_get()
    vertices, faces = blender_data.triangles_of(surface_object, depsgraph)
    problem = Problem(vertices, faces, surface_object=surface_object)
    problem.mask = batch_preparation.mask_of(arguments)
    if problem.mask.source != "NONE":
        problem.surface_options = blender_preparation.surface_options(
            batch_preparation.repair_of(arguments), problem.mask, surface_object, depsgraph
        )
    problem.loose_edges = blender_preparation.loose_edge_count(surface_object, depsgraph)
    problem.density_choice = choice
    radius = arguments.spacing / 2
    problem.density = blender_density.density_of(choice, surface_object, depsgraph, radius)
    problem.alignment = batch_terms.alignment_of(arguments)
    problem.directions = blender_alignment.directions_of(
        problem.alignment, surface_object, depsgraph, radius
    )
    if arguments.seed_object is not None:
        seed_object = bpy.context.scene.objects.get(arguments.seed_object)
        if seed_object is None:
            raise BadInput(
                f"{arguments.input} has no object {arguments.seed_object!r} in its scene; give "
                "the name of a curve object to --seed-object"
            )
        problem.fixed_ends = fixed_ends
        seed = blender_data.strands_of_curve(seed_object, depsgraph, fixed_ends)
        problem.parts.append(strands.Part(seed_object.name, seed))
    if arguments.guides_object is not None:
        guides_object = bpy.context.scene.objects.get(arguments.guides_object)
        if guides_object is None:
            raise BadInput(
                f"{arguments.input} has no object {arguments.guides_object!r} in its scene; give "
                "the name of a curve object to --guides-object"
            )
        guides = blender_data.strands_of_curve(guides_object, depsgraph)
        problem.parts.append(strands.Part(guides_object.name, guides, guide=True))
    return problem


def _mesh_object(arguments: argparse.Namespace) -> bpy.types.Object:
    """--object, else the active mesh object, else the only one."""
    import bpy

    scene_objects = bpy.context.scene.objects
    if arguments.object is not None:
        named = scene_objects.get(arguments.object)
        if named is None:
            raise BadInput(
                f"{arguments.input} has no object {arguments.object!r} in its scene; give the "
                "name of a mesh object to --object"
            )
        return named
    active = bpy.context.view_layer.objects.active
    if active is not None and active.type == "MESH":
        return active
    meshes = [item for item in scene_objects if item.type == "MESH"]
    if len(meshes) != 1:
        found = "no mesh object" if not meshes else f"{len(meshes)} mesh objects, none of it active"
        raise BadInput(f"{arguments.input} has {found}; name one with --object")
    return meshes[0]


@contextmanager
def _saved_settings() -> Iterator[None]:
    """Makes ``object.meander`` readable while the block lasts, whether the add-on is on or not."""
    import bpy

    from . import properties

    if hasattr(bpy.types.Object, "meander"):
        yield
        return
    properties.register()
    try:
        yield
    finally:
        properties.unregister()  # what is left registered at exit hangs the bpy module


# ------------------------------------------------------------------------------------------------
# Run


def _run(flow: core.Flow, iteration_limit: int, quiet: bool) -> str:
    """Runs the flow to its end and returns the stop reason.

    The library runs it on a thread of its own, so that this one can print and hear an interruption;
    asking the flow itself between steps would cost a medial axis each time.
    """
    started = time.monotonic()
    printed, printed_at = 0.0, started
    interval = _PROGRESS_ITERATIONS / iteration_limit
    pause = 0.001
    with core.Context() as context:
        flow.start(context)
        try:
            while flow.running:
                time.sleep(pause)
                pause = min(2 * pause, _LONGEST_PAUSE)  # a short run is not waited for
                progress, now = context.progress, time.monotonic()
                due = progress >= printed + interval or now >= printed_at + _PROGRESS_SECONDS
                if due and not quiet and flow.running:
                    print(
                        f"meander: {progress:.1%} of at most {iteration_limit} iterations after "
                        f"{now - started:.1f} s",
                        flush=True,
                    )
                    printed, printed_at = progress, now
        except BaseException:  # an interruption from the keyboard, above all
            context.cancel()
            flow.wait()
            raise
        return flow.wait()


def _summary(reason: str, figures: dict[str, Any]) -> str:
    ending = {
        "converged": "converged",
        "iteration_limit": "reached the iteration limit",
        "stalled": "stalled",
        "cancelled": "was cancelled",
    }.get(reason, reason)
    return (
        f"meander: {ending} after {figures['iterations']} iterations and "
        f"{figures['seconds_total']:.2f} s: {figures['nodes']} nodes, length "
        f"{figures['length']:.6g}, spacing {figures['spacing_median']:.4g} in the median "
        f"({figures['spacing_target']:.4g} wanted)"
    )


# ------------------------------------------------------------------------------------------------
# Output


def _write_scene(
    path: Path,
    arguments: argparse.Namespace,
    problem: Problem,
    curve: core.Polylines,
    data: core.PointData,
    guides: NDArray[np.bool_],
) -> None:
    """Adds the curve beside its surface and saves a copy of the scene at `path`.

    The curve keeps what it was made with, so that Continue works on it in a window.
    """
    import bpy

    from . import (
        blender_alignment,
        blender_data,
        blender_density,
        blender_preparation,
        blender_terms,
        point_attributes,
        properties,
        strand_data,
    )

    surface_object = problem.surface_object
    if surface_object is None:
        _empty_scene()
        name = arguments.input.stem
        mesh = bpy.data.meshes.new(name)
        mesh.from_pydata(problem.vertices.tolist(), [], problem.faces.tolist())
        mesh.update()
        surface_object = bpy.data.objects.new(name, mesh)
        bpy.context.scene.collection.objects.link(surface_object)
    name = f"{surface_object.name} Meander"
    whole = curve
    distance = thinning.merge_distance(arguments.spacing / 2, problem.density)
    kept = thinning.kept_points(whole, distance)
    curve = thinning.thinned(whole, distance)
    curve_object = blender_data.write_curve(curve, surface_object, name)
    with _saved_settings():
        properties.copy_settings(surface_object.meander, curve_object.meander)
        made_with = curve_object.meander
        made_with.surface = surface_object
        made_with.spacing = arguments.spacing
        made_with.preset = arguments.preset.upper()
        made_with.medial_axis = arguments.medial_axis.upper()
        blender_density.store_choice(problem.density_choice, made_with)
        blender_alignment.store_alignment(problem.alignment, made_with)
        blender_terms.store_terms(batch_terms.terms_of(arguments), made_with)
        made_with.seed_every_part = arguments.fill_every_part
        if arguments.guides_object is not None:
            made_with.guides = bpy.context.scene.objects.get(arguments.guides_object)
        made_with.keep_guides = not arguments.leave_out_guides
        strand_data.note_guides(curve_object, guides, keep=True)
        matrix = blender_data.world_matrix(surface_object)
        point_attributes.remember_room(curve_object, data.radii[kept], matrix)
        if arguments.points is not None:
            made_with.points_as = arguments.points.upper()
            made_with.figures.points = point_attributes.make(
                made_with.points_as,
                f"{curve_object.name} Points",
                toolpath.strands_of(whole, data),
                surface_object,
                matrix,
            )
        blender_preparation.store_repair(problem.repair, made_with)
        blender_preparation.store_mask(problem.mask, made_with)
        made_with.use_outline = arguments.outline
        if arguments.border_distance is not None:
            made_with.border_distance = arguments.border_distance
        try:
            batch_motion.bake(arguments, curve_object)
        except blender_data.DataError as refusal:
            raise BadInput(f"the frames cannot be baked: {refusal}") from refusal
        try:
            bpy.ops.wm.save_as_mainfile(
                filepath=str(path.absolute()), copy=True, check_existing=False
            )
        except RuntimeError as failure:
            raise BadInput(
                f"Blender cannot save {arguments.output} ({' '.join(str(failure).split())}); "
                "choose another place"
            ) from failure


def _write_outputs(
    arguments: argparse.Namespace,
    problem: Problem,
    curve: core.Polylines,
    data: core.PointData,
    guides: NDArray[np.bool_],
    record: dict[str, Any],
) -> None:
    """Writes both files beside their places first, then moves the curve in and then the report."""
    with ExitStack() as stack:  # leaves in reverse order
        report_path = None
        if arguments.report is not None:
            report_path = stack.enter_context(mesh_files.atomic_output(arguments.report))
        curve_path = stack.enter_context(mesh_files.atomic_output(arguments.output))
        if arguments.output.suffix.lower() == ".obj":
            mesh_files.write_obj_curve(curve_path, curve)
        elif batch_toolpath.is_wanted(arguments.output):
            mesh = toolpath.Mesh(problem.vertices, problem.faces)
            batch_toolpath.write(curve_path, arguments, curve, data, mesh)
        else:
            _write_scene(curve_path, arguments, problem, curve, data, guides)
        if report_path is not None:
            report.write_report(report_path, record)


# ------------------------------------------------------------------------------------------------
# The command


def _surface(problem: Problem, threads: int) -> core.Surface:
    try:
        return core.Surface(problem.vertices, problem.faces, problem.surface_options, threads)
    except core.MeanderError as error:
        if problem.surface_object is None:
            raise
        import bpy

        from . import blender_data

        depsgraph = bpy.context.evaluated_depsgraph_get()
        raise blender_data.in_polygons(error, problem.surface_object, depsgraph) from error


def _process(argv: Sequence[str]) -> None:
    arguments = _parser().parse_args(argv)
    _check_arguments(arguments)
    if arguments.output.suffix.lower() == ".blend":
        _need_bpy(arguments.output)
        _refuse_points(arguments.points)
    options = _flow_options(arguments)
    problem = _read_problem(arguments)
    options.alignment_weight = problem.alignment.weight
    warnings = core.option_warnings(options)
    for warning in warnings:
        print(f"meander: warning: {warning}", file=sys.stderr, flush=True)
    with _surface(problem, arguments.threads) as surface:
        problem.density = evaluated(problem.density, surface)
        surface_figures = surface.statistics()
        if arguments.outline:
            problem.seed, surface_figures["skipped_outlines"] = outlined(
                problem.seed,
                surface,
                options.border_distance * arguments.spacing,
                arguments.spacing,
            )
        try:
            flow = core.Flow(surface, options, problem.seed, problem.density)
            directions = evaluated(problem.directions, surface)
            if directions is not None:
                flow.set_directions(directions, problem.alignment.kind)
        except core.MeanderError as refusal:
            raise strands.explained(refusal, problem.parts) from refusal
    with flow:
        reason = _run(flow, options.iteration_limit, arguments.quiet)
        figures = flow.statistics()
        figures["stop_reason"] = reason
        history = flow.history()
        gaps = flow.gaps()
        curve = flow.polylines()
        data = flow.point_data()
        guides = flow.guides()
        if arguments.leave_out_guides:
            kept = strands.points_without_guides(curve, guides)
            data = core.PointData(*(values[kept] for values in data))
            curve = strands.without_guides(curve, guides)
            guides = guides[~guides]
    record = report.build_report(
        core.library_version(),
        surface_figures,
        figures,
        history,
        gaps,
        _echo(arguments, options, problem),
    )
    record["warnings"] = warnings
    record["preparation"] = batch_preparation.counts(surface_figures, problem.loose_edges)
    _write_outputs(arguments, problem, curve, data, guides, record)
    if not arguments.quiet:
        if figures["empty_components"]:
            print(f"meander: {strands.empty_parts(figures['empty_components'])}")
        done = described(surface_figures, problem.loose_edges)
        if done:
            print(f"meander: {done}")
        print(_summary(reason, figures))
        print(f"meander: wrote {arguments.output}", flush=True)


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the command and returns its exit code; see the top of this file.

    argv   the options; None takes those of this process
    """
    try:
        _process(_arguments_of_process() if argv is None else argv)
    except (BadInput, core.MeanderError, mesh_files.FileError) as problem:
        if getattr(problem, "status", None) == core.Status.INTERNAL:
            traceback.print_exc()
            return 1
        print(f"meander: {' '.join(str(problem).split())}", file=sys.stderr, flush=True)
        return 2
    except KeyboardInterrupt:
        print("meander: interrupted", file=sys.stderr, flush=True)
        return 130
    except Exception:
        traceback.print_exc()
        return 1
    return 0


if __name__ == "__main__":
    # Without a window Blender takes Ctrl-C for its renderer, and Python never hears of it.
    if signal.getsignal(signal.SIGINT) != signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    sys.exit(main())
