# SPDX-License-Identifier: GPL-3.0-or-later
"""The rows of the table of options that are about the surface and its fields."""

from __future__ import annotations

from ..geometry.simplification import DEFAULT_SHARE, GREATEST_SHARE, Light
from .option import Flag, Option, Values

_DENSITY, _DIRECTION, _STRANDS = "Density", "Direction", "Seed and Strands"
_REGION, _REPAIR = "Region", "Mesh Repair"
_GUIDANCE, _MAKE = "Guidance", "Make"
_TERMS, _PART, _REPAIRS = "terms of the energy", "part to fill", "mesh repair"

ROWS: tuple[Option, ...] = (
    Option(
        "mirror",
        "Symmetry",
        "Fill one half of the mesh, and the other with its mirror image, joined to one closed line "
        "by two crossings of the plane. The half with the seed counts, else the positive one",
        _GUIDANCE,
        kind=str,
        default="none",
        choices=(
            ("none", "Off", "Fill the mesh as a whole"),
            ("x", "X", "The halves lie on either side of the object's origin along its X axis"),
            ("y", "Y", "The halves lie on either side of the object's origin along its Y axis"),
            ("z", "Z", "The halves lie on either side of the object's origin along its Z axis"),
        ),
        flag=Flag(
            "--mirror",
            "fill one half on an axis of the object, and the other with its mirror image",
            entry="mirror",
            default="none",
        ),
    ),
    Option(
        "hide_seam",
        "Hide Seam",
        "Have strands cross the plane of symmetry at right angles instead of running along both "
        "sides of it. Hairpins beside it then lie elsewhere on either half, and unless directions "
        "are given the curve begins full",
        _GUIDANCE,
        kind=bool,
        default=False,
        flag=Flag(
            "--hide-seam",
            "with --mirror: strands cross the plane instead of running along it",
            entry="hide_seam",
        ),
    ),
    Option(
        "density_smoothing",
        "Smoothing",
        "Radius over which the curvature is averaged, in spacings; a larger one "
        "ignores small features, 0 keeps every dent",
        _DENSITY,
        low="every dent counts",
        high="only large forms count",
        unit="r",
        default=2.0,
        least=0.0,
        soft_greatest=10.0,
        digits=1,
        step=50,
        flag=Flag(
            "--density-smoothing",
            "radius over which the curvature is averaged, in half spacings; default: 2",
            "density",
            "S",
            least=0.0,
        ),
    ),
    Option(
        "alignment_weight",
        "Strength",
        "How strongly strands follow the directions; 1 is clearly visible, much larger values "
        "make the spacing less even",
        _DIRECTION,
        low="a hint of a direction",
        high="rows, with a less even spacing where directions meet",
        default=1.0,
        least=0.0,
        greatest=1e6,
        soft_greatest=5.0,
        flag=Flag(
            "--alignment",
            "weight of the field of --direction; 0.5 to 1 steer, 4 rules; default: 1 with a field",
            _TERMS,
            "W",
            least=0.0,
        ),
    ),
    Option(
        "align_across",
        "Across",
        "Run at right angles to the directions instead of along them",
        _DIRECTION,
        kind=bool,
        default=False,
        flag=Flag("--across", "lie across the field instead", _TERMS, entry="across"),
    ),
    Option(
        "alignment_smoothing",
        "Smoothing",
        "Radius over which the curvature is averaged, in spacings; a larger one "
        "ignores small features, 0 keeps every dent",
        _DIRECTION,
        low="every dent turns the strands",
        high="only large forms do",
        unit="r",
        default=2.0,
        least=0.0,
        soft_greatest=10.0,
        digits=1,
        step=50,
        flag=Flag(
            "--direction-smoothing",
            "radius over which the curvature is averaged, in half spacings; default: 2",
            _TERMS,
            "S",
            least=0.0,
        ),
    ),
    Option(
        "seed_every_part",
        "Fill Every Part",
        "Give a small loop to each part of the mesh, and to each region between guides, that "
        "the seed leaves out. Without a seed they all have one",
        _STRANDS,
        kind=bool,
        default=False,
        flag=Flag(
            "--fill-every-part",
            "small loops on parts of the mesh, and between guides, that the seed leaves out",
            "strands",
            entry="fill_every_part",
        ),
    ),
    Option(
        "bridge_parts",
        "Bridge Parts",
        "Join all strands of the finished curve to one line, by short straight bridges where they "
        "come nearest to each other. Guides stay by themselves",
        _STRANDS,
        kind=bool,
        default=False,
        flag=Flag(
            "--bridge",
            "join all strands to one line, by short bridges where they come nearest",
            "strands",
            entry="bridge",
        ),
    ),
    Option(
        "mask_threshold",
        "Threshold",
        "Weight at which the boundary runs, cutting through faces",
        _REGION,
        low="more of the mesh is filled",
        high="less of it is",
        unit="share",
        default=0.5,
        least=0.0,
        greatest=1.0,
        step=3,
        flag=Flag(
            "--mask-threshold",
            "the least weight in --mask-group of what is filled; default: 0.5",
            _PART,
            "X",
            least=0.0,
            greatest=1.0,
        ),
    ),
    Option(
        "mask_inverted",
        "Invert",
        "Fill what would be left out, and leave out what would be filled",
        _REGION,
        kind=bool,
        default=False,
        flag=Flag("--mask-invert", "fill the rest instead", _PART),
    ),
    Option(
        "use_outline",
        "Outline First",
        "Place a fixed strand along every boundary at the boundary distance first, and fill what "
        "is left inside",
        _REGION,
        kind=bool,
        default=False,
        flag=Flag(
            "--outline",
            "place a fixed strand along every boundary at that distance first",
            _PART,
            entry="outline",
        ),
    ),
    Option(
        "smallest_part",
        "Smallest Part",
        "Separate parts of the mesh that are smaller than this are left out: the diagonal of their "
        "bounding box, in world units; 0 leaves out none",
        _REGION,
        low="every speck gets a line",
        high="only the main parts are filled",
        row="Least Part",
        unit="length",
        default=0.0,
        least=0.0,
        soft_greatest=10.0,
        digits=4,
        step=1,
        flag=Flag(
            "--smallest-part",
            "leave out parts whose bounding box has a smaller diagonal: a length, or per cent of "
            "that of the whole mesh, such as 2%%",
            _PART,
            "SIZE",
            least=0.0,
            share=True,
        ),
    ),
    Option(
        "strict",
        "Strict",
        "Refuse a mesh with faults and say what is wrong, instead of repairing the copy that is "
        "filled. The mesh itself never changes",
        _REPAIR,
        kind=bool,
        default=False,
        flag=Flag("--strict", "refuse a mesh with faults instead of repairing them", _REPAIRS),
    ),
    Option(
        "use_merge",
        "Merge Close Vertices",
        "Treat vertices that are very close together as one; the mesh itself does not change",
        _REPAIR,
        kind=bool,
        default=False,
    ),
    Option(
        "merge_distance",
        "Distance",
        "Vertices closer together than this are one, in world units",
        _REPAIR,
        low="only what is in one place is joined",
        high="small detail collapses",
        unit="length",
        default=0.0001,
        least=0.0,
        soft_greatest=0.1,
        digits=5,
        step=1,
        switch="use_merge",
        flag=Flag(
            "--merge-distance",
            "vertices closer together than this become one",
            _REPAIRS,
            "D",
            least=0.0,
        ),
    ),
    Option(
        "drop_degenerate",
        "Dissolve Degenerate",
        "Remove faces without area and duplicate faces even if Strict refuses other faults",
        _REPAIR,
        kind=bool,
        default=False,
        flag=Flag(
            "--drop-degenerate", "with --strict: dissolve faces without area all the same", _REPAIRS
        ),
    ),
    Option(
        "split_bow_ties",
        "Split Bow-Ties",
        "Separate faces that meet in one vertex only even if Strict refuses other faults",
        _REPAIR,
        kind=bool,
        default=False,
        flag=Flag(
            "--split-bow-ties",
            "with --strict: separate faces that meet in one vertex only all the same",
            _REPAIRS,
        ),
    ),
    Option(
        "cut_non_manifold",
        "Cut Non-Manifold Edges",
        "Treat edges with more than two faces as boundaries, at which every sheet ends. Off: faces "
        "that continue each other stay joined there",
        _REPAIR,
        kind=bool,
        default=False,
        flag=Flag(
            "--cut-non-manifold",
            "edges with more than two faces become boundaries of each; else faces that continue "
            "each other stay joined",
            _REPAIRS,
        ),
    ),
    Option(
        "use_light",
        "Light Result",
        "Leave out points that are not seen, so that curves of very many stay easy to work with. "
        "Pieces then no longer lie in one face each",
        _MAKE,
        kind=bool,
        default=False,
    ),
    Option(
        "light_tolerance",
        "Tolerance",
        "How far the light curve may be from the whole one, in spacings; 0.01 leaves a quarter of "
        "the points and is not seen, 0.05 a tenth",
        _MAKE,
        low="more points, nothing to be seen",
        high="few points, visible corners",
        unit="spacing",
        default=DEFAULT_SHARE,
        least=0.0,
        greatest=GREATEST_SHARE,
        soft_greatest=0.05,
        digits=3,
        step=1,
        switch="use_light",
        flag=Flag(
            "--light",
            "leave out points within this distance of the curve, in spacings, from 0 to "
            f"{GREATEST_SHARE:g}; {DEFAULT_SHARE:g} is not seen",
            "light results",
            "TOL",
            least=0.0,
            greatest=GREATEST_SHARE,
            entry="light",
        ),
    ),
    Option(
        "point_limit",
        "Point Limit",
        "The largest number of points of the light curve, for which the tolerance is raised up to "
        "a quarter of the spacing; 0 is no limit",
        _MAKE,
        low="a lighter, more angular curve",
        high="no effect once the tolerance allows fewer",
        kind=int,
        default=0,
        least=0,
        greatest=2**31 - 1,
        soft_greatest=1000000,
        switch="use_light",
        zero_is_preset=True,
        flag=Flag(
            "--point-limit",
            "at most N points, where a tolerance of a quarter of the spacing allows it; "
            f"without --light the tolerance is {DEFAULT_SHARE:g} where that is enough",
            "light results",
            "N",
            least=1,
            greatest=2**31 - 1,
            entry="point_limit",
        ),
    ),
)


def light_of(values: Values) -> Light | None:
    """What the rows of the table say; None: all points stay."""
    share, limit = values.get("light_tolerance"), values.get("point_limit")
    if share is None and limit is None:
        return None
    return Light(DEFAULT_SHARE if share is None else share, limit or 0)
