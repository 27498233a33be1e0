"""What the Python layer of models refuses before it reaches the core, which reads as many numbers as there must be."""

from __future__ import annotations

import pytest

from edesign.core import Analysis, CoreError, Model, MultilinearSpring


@pytest.fixture
def ends() -> tuple[Model, int, int, int]:
    """A model in space with an elastic section and two nodes."""
    m = Model(3)
    return m, m.elastic_section(1e9, 1e7, 1e7, 1e6), m.node("i", 0.0, 0.0, 0.0), m.node("j", 0.0, 0.0, 3.0)


@pytest.mark.parametrize("web", [(), (1.0, 0.0), (1.0, 0.0, 0.0, 0.0)])
def test_web_has_three_components(ends: tuple[Model, int, int, int], web: tuple[float, ...]) -> None:
    m, section, i, j = ends
    with pytest.raises(ValueError, match="element column"):
        m.beam_column("column", i, j, section, web=web)


def test_releases_are_four(ends: tuple[Model, int, int, int]) -> None:
    m, section, i, j = ends
    with pytest.raises(ValueError, match="2 releases"):
        m.beam_column("column", i, j, section, web=(1.0, 0.0, 0.0), release=(True, False))


def test_web_is_asked_for(ends: tuple[Model, int, int, int]) -> None:
    m, section, i, j = ends
    with pytest.raises(CoreError, match="column.*web"):
        m.beam_column("column", i, j, section)


@pytest.mark.parametrize("dimension", [2, 3])
def test_springs_have_a_coefficient_for_each_degree(dimension: int) -> None:
    m = Model(dimension)
    i, j = m.node("i", 0.0, 0.0), m.node("j", 0.0, 0.0)
    other = 6 if dimension == 3 else 12
    with pytest.raises(ValueError, match="spring pad: "):
        m.spring("pad", i, j, [1.0] * other, MultilinearSpring(1e6))
    assert m.spring("pad", i, j, [1.0] * (18 - other), MultilinearSpring(1e6)) == 0


def test_a_plane_has_no_degrees_of_space() -> None:
    m = Model(2)
    node = m.node("n", 0.0, 0.0)
    with pytest.raises(ValueError, match="uz"):
        m.fix(node, uz=True)
    with pytest.raises(ValueError, match="rx, ry"):
        m.mass(node, 1.0, mrx=1.0, mry=1.0)
    with pytest.raises(ValueError, match="uz"):
        m.nodal_load(m.pattern(), node, fz=1.0)
    with pytest.raises(CoreError, match="plane"):
        m.diaphragm(node, [m.node("o", 1.0, 0.0)])


def test_a_plane_leaves_nothing_out_without_a_word() -> None:
    m = Model(2)
    i, j = m.node("i", 0.0, 0.0), m.node("j", 0.0, 3.0)
    with pytest.raises(ValueError, match="no z"):
        m.node("k", 0.0, 0.0, 1.0)
    beam = m.beam_column("beam", i, j, m.elastic_section(1e9, 1e7))
    pattern = m.pattern()
    with pytest.raises(ValueError, match="transverse_z"):
        m.uniform_load(pattern, beam, 0.0, 1.0, 1.0)
    with pytest.raises(ValueError, match="transverse_z"):
        m.point_load(pattern, beam, 0.5, transverse_z=1.0)
    m.fix(i, ux=True, uy=True, rz=True)
    m.mass(j, 1.0)
    with pytest.raises(ValueError, match="along y"):
        Analysis(m).history([0.0, 1.0], 0.1, along_y=[0.0, 1.0])
