"""What still stands under other settings: the settings are really applied, and their effect is really measured."""

import pytest

from pat3d.check.settings import SETTINGS, check_settings, chosen_settings
from pat3d.cli.main import main
from pat3d.errors import SpecError
from pat3d.exporters.mjcf.writer import write_mjcf
from tests.scenes import tower


@pytest.fixture(scope="module")
def reports(tmp_path_factory):
    path = write_mjcf(tower(2), tmp_path_factory.mktemp("mjcf") / "mjcf")
    return {one.setting.name: one.report for one in check_settings(path, chosen_settings(["all"]), seconds=0.5)}


def test_the_file_as_written_comes_first_and_every_setting_follows(reports):
    assert list(reports) == ["as-written", *SETTINGS]


@pytest.mark.parametrize(
    ("name", "option", "value"),
    [
        ("as-written", "integrator", "implicitfast"),
        ("integrator-euler", "integrator", "euler"),
        ("integrator-rk4", "integrator", "rk4"),
        ("integrator-implicit", "integrator", "implicit"),
        ("solver-cg", "solver", "cg"),
        ("solver-pgs", "solver", "pgs"),
        ("cone-pyramidal", "cone", "pyramidal"),
        ("timestep-1ms", "timestep", 0.001),
        ("timestep-5ms", "timestep", 0.005),
        ("impratio-1", "impratio", 1.0),
        ("defaults", "cone", "pyramidal"),
    ],
)
def test_each_setting_is_what_the_engine_ran_with(reports, name, option, value):
    assert reports[name].settings[option] == value


def test_soft_contacts_let_a_tower_sink_further_than_it_was_verified_with(reports):
    """MuJoCo's solref of 0.02 s under gravity gives way by some tenths of a millimetre, that of 0.004 s by less."""
    assert reports["contacts-default"].worst_mm > 3 * reports["as-written"].worst_mm
    assert reports["as-written"].passed


def test_names_are_chosen_once_and_unknown_ones_are_listed():
    assert [one.name for one in chosen_settings(["solver-cg,cone-pyramidal", "solver-cg"])] == [
        "solver-cg",
        "cone-pyramidal",
    ]
    with pytest.raises(SpecError, match=r"unknown setting \"warp\".*integrator-euler.*all"):
        chosen_settings(["warp"])


def test_the_command_prints_a_row_for_every_setting(tmp_path, capsys):
    write_mjcf(tower(1), tmp_path / "mjcf")
    assert main(["check", str(tmp_path), "--settings", "cone-pyramidal,timestep-5ms", "--seconds", "0.2"]) == 0
    said = capsys.readouterr().out
    assert said.count("stands") == 4
    assert "as written" in said
    assert "time step 5 ms" in said
    assert main(["check", str(tmp_path), "--settings", "all", "--seconds", "-1"]) == 2
