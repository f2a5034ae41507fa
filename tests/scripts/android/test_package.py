"""What goes into the Android package, and which mistakes in its description are caught."""

from __future__ import annotations

from pathlib import Path

import pytest

from scripts.android import package as check
from scripts.android.failure import Failed

ROOT = Path(__file__).parents[3]


@pytest.fixture
def spec():
    return check.read_spec(ROOT / "buildozer.spec")


def test_only_the_handheld_is_packed(spec):
    files = check.check_files(ROOT, spec)
    assert {path.parts[0] for path in files} == {"main.py", "app", "widgets", "bridge"}


def test_a_stranger_in_the_package_is_refused(spec, tmp_path):
    for name in ("main.py", "app/a.py", "widgets/a.py", "bridge/a.py", "gateway/a.py"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("")
    with pytest.raises(Failed, match="gateway/a.py"):
        check.check_files(tmp_path, spec)


def test_a_file_of_the_handheld_that_would_be_left_behind_is_told(spec, tmp_path):
    for name in ("main.py", "app/a.py", "app/layout.csv", "widgets/a.py", "bridge/a.py"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("")
    with pytest.raises(Failed, match="lack app/layout.csv"):
        check.check_files(tmp_path, spec)


def test_what_only_makes_the_messages_stays_at_home(spec, tmp_path):
    names = (
        "main.py",
        "app/a.py",
        "widgets/a.py",
        "bridge/a.py",
        "bridge/generate/a.py",
        "bridge/definitions/a.txt",
    )
    for name in names:
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("")
    assert {path.as_posix() for path in check.check_files(tmp_path, spec)} == set(names[:4])
    spec["source.exclude_dirs"] = spec["source.exclude_dirs"].replace("bridge/generate, ", "")
    with pytest.raises(Failed, match=r"carry bridge/generate/a\.py, which only a desktop needs"):
        check.check_files(tmp_path, spec)


def test_hidden_files_and_files_without_a_suffix_stay_out(spec, tmp_path):
    for name in ("main.py", ".secret", "LICENSE", "Makefile", "app/data.csv"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("")
    assert list(check.selected(tmp_path, spec)) == [Path("main.py")]


def test_the_requirements_keep_their_pins(spec):
    assert {"websockets==15.0.1", "spake2==0.8", "hkdf==0.0.3"} <= set(check.check_requirements(spec))


@pytest.mark.parametrize(
    "bad", ["kivy>=2.3", "charset-normalizer==3.4.2", "Kivy==2.3.1", "pybullet", "cryptography"]
)
def test_a_requirement_that_would_break_the_build_is_refused(spec, bad):
    spec["requirements"] = f"python3,{bad}"
    with pytest.raises(Failed, match=bad.split("=")[0].split(">")[0]):
        check.check_requirements(spec)


def test_the_manifest_options_hold(spec):
    check.check_options(ROOT, spec)
    spec["android.features"] = "android.hardware.camera"
    with pytest.raises(Failed, match="android.features"):
        check.check_options(ROOT, spec)


def test_an_import_that_the_spec_does_not_ask_for_is_refused(tmp_path):
    (tmp_path / "main.py").write_text("import kivy\nimport requests\n")
    with pytest.raises(Failed, match="requests"):
        check.check_imports([Path("main.py")], tmp_path, ["python3", "kivy==2.3.1"])


def test_the_handheld_imports_nothing_that_the_spec_does_not_ask_for(spec):
    check.check_imports(check.check_files(ROOT, spec), ROOT, check.check_requirements(spec))


def test_a_name_with_a_dot_may_be_asked_for_with_an_underscore(tmp_path):
    (tmp_path / "main.py").write_text("import ruamel.yaml\nimport kivy_garden.mapview\n")
    check.check_imports([Path("main.py")], tmp_path, ["ruamel_yaml==0.19.1", "kivy_garden.mapview==1.0.6"])


def test_what_does_not_compile_is_told_with_its_file(tmp_path):
    (tmp_path / "main.py").write_text("def broken(:\n")
    with pytest.raises(Failed, match=r"main\.py"):
        check.compile_all(tmp_path)


def test_a_module_that_needs_what_a_phone_does_not_have_is_told(tmp_path):
    (tmp_path / "main.py").write_text("import PIL\n")
    with pytest.raises(Failed, match="PIL is not on the phone"):
        check.import_all(tmp_path, [Path("main.py")])
