# SPDX-License-Identifier: GPL-3.0-or-later
"""What a job file may say: the items that come of it, and one sentence for every mistake."""

from __future__ import annotations

import json
import os
import shlex
from pathlib import Path

import pytest
from conftest import ROOT
from meander.jobs import command, job_file, options
from meander.jobs import items as items_module
from meander.jobs.folder import Folder
from meander.jobs.items import items_of
from meander.jobs.job_file import JobError
from sentences import assert_sentence

ITEM = '[[items]]\ninput = "meshes/a.obj"\n'
SPACING = "[defaults]\nspacing = 0.3\n"


class Listed:
    """Says which meshes a .blend holds, in place of Blender."""

    @staticmethod
    def of(_path: Path) -> list[str]:
        return ["Ball", "Rock 1", "Rock 2", "[x]"]


@pytest.fixture
def items(job):
    """The items of a job file with this text."""
    job.meshes(a="ok", b="ok")
    (job.folder / "shot.blend").write_text("")

    def read(text: str) -> list:
        job.write(text, fake=False)
        return items_of(job_file.read(job.file), Listed())

    return read


@pytest.fixture
def refused(job, capsys):
    """The sentence for a job file, or for arguments, that cannot be run; nothing is written."""
    job.meshes(a="ok", b="ok")
    (job.folder / "shot.blend").write_text("")

    def call(text: str, *arguments: str) -> str:
        job.write(text, fake=False)
        assert command.main([str(job.file), *arguments]) == 2
        captured = capsys.readouterr()
        assert captured.out == ""
        sentence = captured.err.rstrip("\n")
        assert_sentence(sentence)
        assert sentence.startswith("meander: ")
        assert sentence.isprintable() and len(sentence) < 600
        assert not job.results.exists()
        return sentence

    return call


# ------------------------------------------------------------------------------------------------
# What comes of a file


def test_a_pattern_makes_an_item_of_every_file(items, job):
    found = items(SPACING + '[[items]]\ninput = "meshes/*.obj"\n')
    assert [item.name for item in found] == ["a", "b"]
    assert [item.options.input for item in found] == [
        job.folder / "meshes" / name for name in ("a.obj", "b.obj")
    ]
    assert found[0].options.output == job.folder / "job" / "a.obj"
    assert found[0].report == job.folder / "job" / "a.report.json"
    assert found[0].options.spacing == 0.3


def test_an_item_overrides_the_defaults(items):
    text = "[defaults]\nspacing = 0.3\nbending = 2\nstrict = true\ntimeout = 5\n"
    found = items(text + '[[items]]\ninput = ["meshes/a.obj", "meshes/b.obj"]\nspacing = 0.1\n'
                  "strict = false\nmax_radius = 0.4\ntimeout = 7.5\n")
    assert {item.options.spacing for item in found} == {0.1}
    assert {item.options.bending for item in found} == {2}
    assert {item.options.strict for item in found} == {False}
    assert {item.options.max_radius for item in found} == {0.4}
    assert {item.timeout for item in found} == {7.5}


def test_objects_and_frames_multiply(items):
    found = items(SPACING + '[[items]]\ninput = "shot.blend"\nobject = ["Rock *", "[x]"]\n'
                  'frames = "-1-3:2, 10"\n')
    assert [item.name for item in found][:5] == [
        "shot-Rock_1--001", "shot-Rock_1-0001", "shot-Rock_1-0003", "shot-Rock_1-0010",
        "shot-Rock_2--001",
    ]  # fmt: skip
    assert len(found) == 12
    assert {item.options.object for item in found} == {"Rock 1", "Rock 2", "[x]"}
    assert [item.options.frame for item in found[:4]] == [-1, 1, 3, 10]


def test_an_object_without_a_pattern_is_left_to_the_item(items):
    (found,) = items(SPACING + '[[items]]\ninput = "shot.blend"\nobject = "Nobody"\n')
    assert found.options.object == "Nobody"


def test_names_and_outputs_follow_their_patterns(items, job):
    found = items(SPACING + '[[items]]\ninput = "meshes/*.obj"\nname = "{folder}/{stem}-fine"\n'
                  'output = "{name}.svg"\nlayout = "top"\n')
    assert [item.name for item in found] == ["meshes/a-fine", "meshes/b-fine"]
    assert found[0].options.output == job.folder / "job" / "meshes" / "a-fine.svg"
    assert found[0].log == job.folder / "job" / "meshes" / "a-fine.log"


@pytest.mark.parametrize(
    ("what", "name"),
    [
        ('input = "**/b.*"', "{stem}-{suffix}"), ('input = "**/c.obj"', "{folder}-{stem}"),
        ('input = "shot.blend"\nobject = "Rock *"', "{stem}-{object}"),
        ('input = "shot.blend"\nframes = "1-2"', "{stem}-{frame}"),
    ],
)  # fmt: skip
def test_items_of_one_name_are_told_apart_as_is_said(items, job, what, name):
    (job.folder / "deep").mkdir()
    for path in ("meshes/b.PLY", "meshes/c.obj", "deep/c.obj"):
        (job.folder / path).write_text("ok")
    text = f'{SPACING}[[items]]\n{what}\n'
    with pytest.raises(JobError, match="two items are called") as refusal:
        items(text + 'name = "{stem}"\n')
    assert f'name = "{name}"' in str(refusal.value)
    assert len({item.name for item in items(text + f'name = "{name}"\n')}) == 2


def test_what_a_job_has_written_is_not_its_input(items, job):
    job.results.mkdir()
    (job.results / "a.obj").write_text("")
    found = items(SPACING + '[[items]]\ninput = "**/*.obj"\n')
    assert [item.name for item in found] == ["a", "b"]


def test_shards_are_all_items_once(items, job, capsys):
    job.meshes(**{f"m{number}": "ok" for number in range(9)})
    items(SPACING + '[[items]]\ninput = "meshes/*.obj"\n')
    parts = []
    for number in (1, 2, 3):
        assert command.main([str(job.file), "--list", "--shard", f"{number}/3"]) == 0
        parts.append(capsys.readouterr().out.splitlines())
    assert command.main([str(job.file), "--list"]) == 0
    assert sorted(sum(parts, [])) == sorted(capsys.readouterr().out.splitlines())
    assert {len(part) for part in parts} == {3, 4}


def test_every_flag_of_the_batch_command_may_stand_in_a_file():
    known = {key for key in options._actions() if key not in options._REFUSED}
    for key in known - {"from", "to"}:
        assert options.check_keys("here", {key: 1}) == {key: 1}
    assert {"spacing", "seed-object", "bake-frames", "cut", "quality"} <= known


def test_the_page_names_every_key_and_flag():
    page = (ROOT / "docs" / "farm.md").read_text()
    keys = {*options.OWN_KEYS, *job_file._JOB_KEYS, *job_file.ENGINES}
    missing = [key for key in keys if f"`{key}`" not in page and f'`"{key}"`' not in page]
    flags = {action.option_strings[-1] for action in command._parser()._actions[2:]}
    assert missing == [] and [flag for flag in flags if f"`{flag}" not in page] == []


def test_the_command_of_an_item(items, job, capsys):
    items(SPACING + "threads = 3\n" + ITEM
          + 'density-curvature = "mean"\nspacing-factors = [1, 0.5]\n')
    assert command.main([str(job.file), "--dry-run"]) == 0
    (line,) = capsys.readouterr().out.splitlines()
    words = shlex.split(line)
    assert words[1].endswith("batch.py") and words[2] == "--"
    assert "--density-curvature=mean" in words and "--threads=3" in words
    at = words.index("--spacing-factors")
    assert words[at + 1 : at + 3] == ["1", "0.5"]
    assert not job.results.exists()


def test_blender_is_used_where_it_is_needed(items, job, capsys):
    items('[job]\nblender = "/opt/blender"\n' + SPACING + ITEM
          + '[[items]]\ninput = "meshes/b.obj"\noutput = "b.blend"\n'
          + '[[items]]\ninput = "shot.blend"\n')
    assert command.main([str(job.file), "--dry-run"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert ["/opt/blender --background" in line for line in lines] == [False, True, True]


# ------------------------------------------------------------------------------------------------
# Mistakes

MISTAKES = {
    "a path of Windows": ('[[items]]\ninput = "C:\\Users\\me\\a.obj"\n', "write paths with /"),
    "another drive": ('[[items]]\ninput = "D:\\meshes\\a.obj"\n', "line 2: a backslash"),
    "a tab in a path": (SPACING + '[[items]]\ninput = "meshes\\tile.obj"\n', "holds a letter"),
    "a new line in a path": (SPACING + '[[items]]\ninput = "meshes\\new.obj"\n', "holds a letter"),
    "inside of a value": (SPACING + ITEM + 'name = "{stem.__class__}"\n', "use {stem}"),
    "a letter of a value": (SPACING + ITEM + 'name = "{stem[0]}"\n', "use {stem}"),
    "a name without end": (SPACING + ITEM + 'name = "{stem:>99999999999}"\n', "use {stem}"),
    "a width that is a name": (SPACING + ITEM + 'name = "{stem:{object}}"\n', "use {stem}"),
    "a blank name": (SPACING + ITEM + 'name = " "\n', "the name is empty"),
    "an empty input": (SPACING + '[[items]]\ninput = ""\n', "input is empty"),
    "a blank input": (SPACING + '[[items]]\ninput = [" "]\n', "input is empty"),
    "a folder as a seed": (SPACING + ITEM + 'seed = "meshes"\n', "is a folder"),
    "no TOML": ("[job", "no TOML"),
    "a point without a digit before it": ("[defaults]\nspacing = .2\n" + ITEM, "write 0.2"),
    "the same in a list": (SPACING + ITEM + "from = [0, -.5, 1]\n", "write 0.2"),
    "a point without a digit behind it": ("[defaults]\nspacing = 2.\n" + ITEM, "write 0.2"),
    "a long name": (SPACING + ITEM + f'name = "{"x" * 300}"\n', "too long"),
    "a long output": (SPACING + ITEM + f'output = "a/{"é" * 120}.obj"\n', "too long"),
    "nothing to do": (SPACING, "nothing to do"),
    "nothing at all": ("", "nothing to do"),
    "no table": ("items = 3\n", "[[items]]"),
    "an items table": ('[items]\ninput = "meshes/a.obj"\n', "[[items]]"),
    "outside": ('spacing = 1\n' + ITEM, "'spacing'"),
    "job is no table": ("job = 3\n" + ITEM, "[job]"),
    "key of job": ('[job]\nfoldr = "x"\n' + SPACING + ITEM, "did you mean 'folder'"),
    "kind in job": ("[job]\nfolder = 3\n" + SPACING + ITEM, "folder"),
    "engine": ('[job]\nengine = "rocket"\n' + SPACING + ITEM, "rocket"),
    "command is empty": ("[job]\ncommand = []\n" + SPACING + ITEM, "command"),
    "command is a number": ("[job]\ncommand = 3\n" + SPACING + ITEM, "command is a list"),
    "folder is endless": ("[job]\nfolder = [" + "1, " * 400 + "]\n" + SPACING + ITEM, "..."),
    "command and engine": ('[job]\ncommand = ["x"]\nengine = "auto"\n' + SPACING + ITEM, "command"),
    "no input": (SPACING + '[[items]]\nname = "x"\n', "input is missing"),
    "key of an item": (SPACING + ITEM + "spaceing = 1\n", "did you mean 'spacing'"),
    "key of the defaults": ("[defaults]\nspaceing = 1\n" + ITEM, "[defaults] has the unknown key"),
    "key twice": (SPACING + ITEM + "max-radius = 1\nmax_radius = 2\n", "twice"),
    "report": (SPACING + ITEM + 'report = "x.json"\n', "report"),
    "missing file": (SPACING + '[[items]]\ninput = "meshes/none.obj"\n', "does not exist"),
    "pattern of nothing": (SPACING + '[[items]]\ninput = "meshes/*.stl"\n', "'meshes/*.stl'"),
    "wrong suffix": (SPACING + '[[items]]\ninput = "job.toml"\n', "is no .obj"),
    "input is a number": (SPACING + "[[items]]\ninput = 3\n", "input"),
    "spacing is a word": ('[defaults]\nspacing = "wide"\n' + ITEM, "'wide'"),
    "spacing is a list": ("[defaults]\nspacing = [1, 2]\n" + ITEM, "2"),
    "spacing is a switch": ("[defaults]\nspacing = true\n" + ITEM, "spacing is a number"),
    "switch is a word": (SPACING + ITEM + 'strict = "yes"\n', "true or false"),
    "choice": (SPACING + ITEM + 'quality = "fast"\n', "'fast'"),
    "timeout": (SPACING + ITEM + "timeout = 0\n", "timeout"),
    "timeout without end": (SPACING + ITEM + "timeout = 1" + "0" * 400 + "\n", "timeout"),
    "digits without end": (SPACING + ITEM + "timeout = 1" + "0" * 5000 + "\n", "TOML"),
    "brackets without end": ("job = " + "[" * 5000, "brackets"),
    "memory": (SPACING + ITEM + 'memory = "4 GB"\n', "memory"),
    "seed": (SPACING + ITEM + 'seed = "none.obj"\n', "seed"),
    "options that do not fit": (SPACING + ITEM + "density-range = [0, 1]\n", "source of density"),
    "object of an OBJ": (SPACING + ITEM + 'object = "Ball*"\n', "object"),
    "frames of an OBJ": (SPACING + ITEM + 'frames = "1-3"\n', "--frame"),
    "frames": (SPACING + '[[items]]\ninput = "shot.blend"\nframes = "soon"\n', "'soon'"),
    "no frames": (SPACING + '[[items]]\ninput = "shot.blend"\nframes = "9-3"\n', "9-3"),
    "frame and frames": (
        SPACING + '[[items]]\ninput = "shot.blend"\nframe = 1\nframes = 2\n', "both",
    ),
    "baking in parts": (
        SPACING + '[[items]]\ninput = "shot.blend"\nframes = "1-3"\nbake-frames = [1, 9]\n',
        "goes on from the one before",
    ),
    "name": (SPACING + ITEM + 'name = "{stern}"\n', "{stem}"),
    "name is a number": (SPACING + ITEM + "name = 3\n", "name"),
    "name leads out": (SPACING + ITEM + 'name = "../x"\n', "leads out"),
    "output leads out": (SPACING + ITEM + 'output = "/x.obj"\n', "leads out"),
    "kind of output": (SPACING + ITEM + 'output = "x.xyz"\n', "x.xyz"),
    "one name": (SPACING + ITEM + ITEM, "{stem}-fine"),
    "one output": (SPACING + '[[items]]\ninput = "meshes/*.obj"\noutput = "x.obj"\n', "{name}"),
    "output is the log": (SPACING + ITEM + 'output = "a.report.json"\n', "itself twice"),
    "over an input": (
        '[job]\nfolder = "meshes"\n' + SPACING + '[[items]]\ninput = "meshes/a.obj"\n', "overwrite",
    ),
    "a name that no file can have": (
        SPACING + f'[[items]]\ninput = "{"x" * 5000}.obj"\n', "can be no file",
    ),
    "a header that is none": (SPACING + ITEM + f'header = "{"x" * 5000}"\n', "can be no file"),
    "a blank folder": ('[job]\nfolder = " "\n' + SPACING + ITEM, "folder is empty"),
    "an empty program": ('[job]\npython = ""\n' + SPACING + ITEM, "python is empty"),
    "an empty command": ('[job]\ncommand = [""]\n' + SPACING + ITEM, "command is empty"),
    "key twice, otherwise": (
        SPACING + ITEM + "max_radius = 1\nmax-radius = 2\n", "there twice, as max_radius too",
    ),
    "a sheet over an output": (
        SPACING + ITEM + 'name = "x"\nlayout = "top"\noutput = "a.svg"\nsheet = "a4"\n'
        + ITEM + 'name = "y"\nlayout = "top"\noutput = "A_R1C2.svg"\n',
        "a_r1c2.svg of y; put {name}",
    ),
    "engine without Blender": (
        '[job]\nengine = "python"\n' + SPACING + '[[items]]\ninput = "shot.blend"\n',
        "needs Blender",
    ),
    "no such program": (
        '[job]\ncommand = ["no-such-program"]\n' + SPACING + ITEM, "no-such-program",
    ),
}  # fmt: skip


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "utf-16-le"])
def test_a_job_file_may_be_any_text_of_unicode(job, encoding):
    job.meshes(a="ok")
    job.file.write_bytes(("# Größe\n" + SPACING + ITEM).encode(encoding))
    (item,) = items_of(job_file.read(job.file), Listed())
    assert item.name == "a"


def test_other_text_is_a_sentence(job):
    job.file.write_bytes(("# Größe\n" + SPACING + ITEM).encode("latin-1"))
    with pytest.raises(job_file.JobError, match="is not text in UTF-8; save it again"):
        job_file.read(job.file)


@pytest.mark.skipif(os.sep != "/", reason="they part folders here")
@pytest.mark.parametrize(
    "text",
    [
        "[[items]]\ninput = 'meshes\\a.obj'\n",
        "[[items]]\ninput = 'meshes\\*.obj'\n",
        ITEM + "seed = 'meshes\\b.obj'\n",
        ITEM + "output = 'fine\\a.obj'\n",
        ITEM + "name = 'fine\\a'\n",
    ],
)
def test_paths_of_windows_are_a_sentence_elsewhere(refused, text):
    assert "has backslashes; write paths with /" in refused(SPACING + text)


def test_sheets_of_items_beside_each_other_are_no_mistake(items):
    drawn = 'layout = "top"\nsheet = "a4"\noutput = "{name}.svg"\n'
    assert len(items(SPACING + '[[items]]\ninput = "meshes/*.obj"\n' + drawn)) == 2


@pytest.mark.parametrize("name", MISTAKES)
def test_a_mistake_is_one_sentence(refused, name):
    text, word = MISTAKES[name]
    assert word in refused(text)


@pytest.mark.parametrize(
    "arguments",
    [
        ("--shard", "0/4"), ("--shard", "5/4"), ("--shard", "half"), ("--jobs", "0"),
        ("--slurm", "0"), ("--slurm", "4", "--list"), ("--slurm", "4", "--shard", "1/4"),
        ("--no-such",), ("--summary", ""), ("--summary", "nowhere/a.json"), ("--summary", "/"),
    ],
    ids=" ".join,
)  # fmt: skip
def test_wrong_arguments_are_one_sentence(refused, arguments):
    refused(SPACING + ITEM, *arguments)


def test_objects_of_a_scene_that_is_missing_are_not_asked_for(job, capsys):
    job.write(SPACING + '[[items]]\ninput = "gone.blend"\nobject = "*"\n', fake=False)
    for more in ([], ["--list"]):
        assert command.main([str(job.file), *more]) == 2
        sentence = capsys.readouterr().err.strip()
        assert_sentence(sentence)
        assert "gone.blend cannot be read" in sentence and "check the path" in sentence


def test_a_pattern_of_no_object_names_what_there_is(items):
    with pytest.raises(JobError, match="called 'Stone\\*', but it has Ball, Rock 1, Rock 2"):
        items(SPACING + '[[items]]\ninput = "shot.blend"\nobject = "Stone*"\n')


def test_a_python_without_toml_says_so(job, monkeypatch):
    job.write(SPACING + ITEM)
    monkeypatch.setitem(__import__("sys").modules, "tomllib", None)
    with pytest.raises(JobError, match=r"Python 3\.11 or later") as refusal:
        job_file.read(job.file)
    assert_sentence(str(refusal.value))


def test_a_missing_job_file_is_one_sentence(tmp_path, capsys):
    assert command.main([str(tmp_path / "none.toml")]) == 2
    assert_sentence(capsys.readouterr().err.strip())


def test_the_slurm_script_asks_for_what_the_limits_say(items, job, capsys):
    job.meshes(c="ok", d="ok", e="ok")
    items('[defaults]\nspacing = 0.3\ntimeout = 600\nmemory = 1000\n[[items]]\n'
          'input = "meshes/*.obj"\n')
    assert command.main([str(job.file), "--slurm", "2", "--jobs", "2"]) == 0
    script = capsys.readouterr().out.splitlines()
    assert script[0] == "#!/bin/sh"
    assert "#SBATCH --array=1-2" in script
    assert "#SBATCH --cpus-per-task=2" in script
    assert "#SBATCH --mem=2200M" in script
    # Three items, two at once: two times 600 s, and a minute to begin.
    assert "#SBATCH --time=21" in script
    words = shlex.split(script[-1])
    assert words[0] == "exec" and words[-2:] == ["--shard", "$SLURM_ARRAY_TASK_ID/2"]
    assert json.dumps(str(job.file)) in json.dumps(words)


def test_slurm_gets_no_more_tasks_than_items(items, job, capsys):
    items(SPACING + '[[items]]\ninput = "meshes/*.obj"\n')
    assert command.main([str(job.file), "--slurm", "40"]) == 0
    script = capsys.readouterr().out
    assert "#SBATCH --array=1-2\n" in script
    assert "--mem" not in script and "--time" not in script


def test_names_that_differ_in_capitals_only_are_two_files_everywhere(items, job):
    """On Windows and macOS "Leaf" and "leaf" are one file, and so are two ways to write "é"."""
    job.meshes(Leaf="ok", leaf="ok", LEAF="ok", other="ok")
    found = items(SPACING + '[[items]]\ninput = "meshes/[Ll]*.obj"\n')
    names = [item.name for item in found]
    assert sorted(names) == sorted(["LEAF", "Leaf-2", "leaf-3"])
    written = [str(path).casefold() for item in found for path in (*item.written, item.log)]
    assert len(set(written)) == len(written)
    again = items(SPACING + '[[items]]\ninput = "meshes/[Ll]*.obj"\n')
    assert [item.name for item in again] == names
    job.meshes(**{"e\u0301": "ok", "\u00e9": "ok"})
    found = items(
        SPACING + '[[items]]\ninput = ["meshes/e\u0301.obj", "meshes/\u00e9.obj"]\n'
    )
    assert len({items_module.one_file(item.name) for item in found}) == 2


def test_outputs_that_differ_in_capitals_only_are_refused(refused, job):
    job.meshes(Leaf="ok", leaf="ok")
    text = SPACING + '[[items]]\ninput = "meshes/[Ll]eaf.obj"\noutput = "{stem}.svg"\n'
    assert "put {name} into the output" in refused(text)


@pytest.mark.parametrize("number", ["-0.00001", "-1e-7", "-1E-7", "-0.5", "-1", "-3e-05"])
def test_numbers_that_begin_with_a_dash(items, number: str) -> None:
    (item,) = items(SPACING + ITEM + f"from = [{number}, 0.5, {number}]\nto = [1, 0.5, 0]\n")
    assert item.options.stroke_from == [float(number), 0.5, float(number)]


HEADER = 'output = "{stem}.gcode"\nlayout = "top"\nheader = "mine.txt"\n'


def test_a_header_lies_beside_the_job_file_and_is_not_overwritten(items, refused, job) -> None:
    (job.folder / "mine.txt").write_text("G21\n")
    (item,) = items(SPACING + ITEM + HEADER)
    assert item.options.header == job.folder / "mine.txt"
    (job.folder / "mine.txt").unlink()
    assert "mine.txt" in refused(SPACING + ITEM + HEADER)


@pytest.mark.parametrize("key", ["header", "footer", "seed", "guides", "density-image"])
def test_what_an_item_reads_is_a_part_of_what_it_is(items, job, key: str) -> None:
    text = SPACING + ITEM + HEADER.replace("header", key).replace("txt", "obj")
    path, folder = job.folder / "mine.obj", Folder(job.results)
    keys = []
    for content in ("G21\n", "G21\nM3\n"):
        path.write_text(content)
        (item,) = items(text)
        keys.append(folder.key_of(item))
    assert keys[0] != keys[1]
    path.rename(job.folder / "other.obj")
    (item,) = items(text.replace("mine.obj", "other.obj"))
    assert Folder(job.results).key_of(item) == keys[1]


@pytest.mark.parametrize("summary", ["meshes/Rock.obj", "job.toml", "link.json"])
def test_a_summary_is_never_what_the_job_is_made_of(job, capsys, summary: str) -> None:
    job.meshes(Rock="ok")
    job.write(SPACING + '[[items]]\ninput = "meshes/Rock.obj"\n', fake=False)
    (job.folder / "link.json").symlink_to(job.file)
    victim = job.folder / summary
    before = victim.read_bytes()
    assert command.main([str(job.file), "--status", "--summary", str(victim)]) == 2
    said = capsys.readouterr().err
    assert "the summary" in said and "would overwrite" in said
    assert victim.read_bytes() == before


def test_an_output_is_never_the_summary_of_the_job_nor_its_file(refused, job) -> None:
    job.meshes(Rock="ok")
    text = SPACING + '[[items]]\ninput = "meshes/Rock.obj"\n'
    said = refused(text + 'output = "Summary.json"\nresample-step = 0.1\n')
    assert "which is the summary of the job" in said
    (job.folder / "link").mkdir()
    (job.folder / "link" / "Rock.obj").symlink_to(job.file)
    said = refused('[job]\nfolder = "link"\n' + text)
    assert "which is the job file" in said


def test_images_lie_in_the_folder_of_the_job_and_count_as_written(items, refused, job) -> None:
    (job.folder / "shot.blend").write_text("")
    text = SPACING + '[[items]]\ninput = "shot.blend"\nobject = ["a", "b"]\nmaps = "{0}.png"\n'
    assert "would be written by" in refused(text.replace("{0}", "all"))
    item, _other = items(text.replace("{0}", "{name}"))
    assert item.options.maps == job.results / f"{item.name}.png"
    folder = Folder(job.results)
    folder.make([item])
    for name in ("_mask.png", "_mask.1002.png", "_not.png"):
        (job.results / f"{item.name}{name}").write_text("")
    sizes = folder._sizes_of(item)
    assert set(sizes) == {f"{item.name}_mask.png", f"{item.name}_mask.1002.png"}
    key = folder.key_of(item)
    other = items(text.replace("{0}", "{name}").replace("png", "exr"))[0]
    assert folder.key_of(other) != key


def test_sheets_of_a_drawing_count_as_written(items, job) -> None:
    (job.folder / "leaf.obj").write_text("")
    text = SPACING + '[[items]]\ninput = "leaf.obj"\noutput = "{name}.svg"\nlayout = "top"\n'
    (item,) = items(text + 'sheet = "a4"\n')
    folder = Folder(job.results)
    folder.make([item])
    for name in ("_r1c1.svg", "_r12c3.svg", "_r0c1.svg", "_r1c1.dxf"):
        (job.results / f"{item.name}{name}").write_text("")
    assert set(folder._sizes_of(item)) == {f"{item.name}_r1c1.svg", f"{item.name}_r12c3.svg"}
    (other,) = items(text + 'sheet = "a3"\n')
    assert folder.key_of(other) != folder.key_of(item)


def test_in_a_folder_that_was_deleted_there_is_a_sentence(tmp_path, monkeypatch, capsys) -> None:
    (tmp_path / "gone").mkdir()
    monkeypatch.chdir(tmp_path / "gone")
    (tmp_path / "gone").rmdir()
    assert command.main(["fill.toml"]) == 2
    said = capsys.readouterr().err
    assert_sentence(said.strip())
    assert "change into a folder that exists" in said
