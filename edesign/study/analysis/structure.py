"""A frame ready to be analysed: the core's analysis of it, and its gravity loads."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from edesign.core import Analysis, Channel, CoreError, Model, Modes, Response
from edesign.damper.harmonic import complex_stiffness, effective_stiffness
from edesign.errors import AnalysisError, split_code
from edesign.frame.devices import Device, DeviceLaw
from edesign.frame.frame import build_frame
from edesign.frame.frame_model import FrameModel
from edesign.frame.isolation import goes_with_weight, isolator_under
from edesign.project.analysis_file import AnalysisFile
from edesign.project.building.building import Building
from edesign.project.project import Project
from edesign.space.nonlinear.build import build_building
from edesign.space.nonlinear.masses import IN_PLACE
from edesign.study.analysis.dampers import attachments, device_laws
from edesign.study.analysis.leading_mode import leading_modes

DEFAULT_TOLERANCE = 1e-7  # of analyses in projects without `integration`
GRAVITY_STEPS = 10
_FIRST_GUESS = 0.5  # Hz, of an isolated building, from which the frequency of rate-dependent isolators is found
_AGREEMENT = 1e-9  # of two frequencies that follow each other
_TOLERATED = 1e-5  # after all rounds: steady cycles that SUNDIALS integrates behind a brace repeat to about 1e-6
_MOST_ROUNDS = 50


@dataclass(frozen=True)
class Structure:
    """A frame and the analysis of it.

    Attributes:
        frame: the model with the names of its parts.
        analysis: the core's analysis, at first without loads.
    """

    frame: FrameModel
    analysis: Analysis

    def modes(self, count: int, damper_stiffness: np.ndarray | None = None) -> Modes:
        """Return the lowest natural modes in the present state.

        Without, buckling-restrained braces have that before they yield, isolators that at the design displacement, and
        other dampers none.

        Raises:
            AnalysisError: there are not so many modes, or the structure is unstable.
        """
        if damper_stiffness is None:
            damper_stiffness = self.frame.brace_stiffness
            if self.frame.isolated is not None:
                isolators = self.frame.isolated.devices
                amplitudes = [float(isolator.design_deformation or 0.0) for isolator in isolators]
                return self.steady_modes(count, isolators, amplitudes, damper_stiffness)[0]
        try:
            return self.analysis.modes(count, damper_stiffness)
        except ValueError as error:
            raise AnalysisError(f"modes: {error} [E-MODAL-03]") from error
        except CoreError as error:
            raise AnalysisError(f"modes: {error}") from error

    def steady_modes(
        self, count: int, devices: Sequence[Device], amplitudes: Sequence[float], others: np.ndarray | None = None
    ) -> tuple[Modes, np.ndarray, np.ndarray]:
        """Return the lowest modes with devices that vibrate steadily in the first of them.

        In a building they vibrate in the leading modes of the directions that they act in.

        Args:
            count: how many modes.
            amplitudes: of each, m.
            others: stiffness that dampers have apart from these, (n_dampers,) N/m; None: nothing.

        Returns:
            The modes, and of each device the complex stiffness, N/m, and the frequency at which it vibrates, Hz.

        Raises:
            AnalysisError: there are not so many modes, the structure is unstable, or no frequency agrees with itself.
        """
        added = np.zeros(len(self.frame.model.damper_names)) if others is None else others.copy()
        numbers = [device.number for device in devices]
        if self.frame.isolated:
            frequencies = np.full(len(devices), _FIRST_GUESS)
        else:
            frequencies = self._working(1, None, devices)[1]
        for _ in range(_MOST_ROUNDS):
            states = zip(devices, amplitudes, frequencies.tolist(), strict=True)
            found = np.array([device_stiffness(*state) for state in states])
            added[numbers] = found.real
            before = frequencies
            modes, frequencies = self._working(count, added, devices)
            if np.all(np.abs(frequencies - before) <= _AGREEMENT * frequencies):
                break
        apart = np.abs(frequencies - before) / frequencies
        if apart.max() > _TOLERATED:
            worst = int(apart.argmax())
            raise AnalysisError(
                f"modes: the frequency at which devices vibrate and that of the frame with them did not agree within "
                f"{_MOST_ROUNDS} iterations (last {before[worst]:.6g} Hz and {frequencies[worst]:.6g} Hz) [E-MODAL-01]"
            )
        return modes if modes.omega.size == count else self.modes(count, added), found, frequencies

    @property
    def most_modes(self) -> int:
        """How many modes there are."""
        return int(np.count_nonzero(self.analysis.masses()))

    def _working(self, count: int, stiffness: np.ndarray | None, devices: Sequence[Device]) -> tuple[Modes, np.ndarray]:
        """Lowest modes, at least so many, and the frequency at which each device vibrates in them, (n_devices,) Hz.

        It is that of the first mode. In a building it is that of the leading mode in the direction of the device; of
        one that acts in both or neither the lower of the two.
        """
        if self.frame.model.dimension == 2:
            modes = self.modes(count, stiffness)
            return modes, np.full(len(devices), float(modes.omega[0]) / (2.0 * np.pi))
        directions = self.frame.directions
        modes, leading = leading_modes(lambda n: self.modes(n, stiffness), count, self.most_modes, directions)
        of_axes = [modes.omega[first] for first, *_ in leading]
        chosen = [min(of_axes) if device.direction is None else of_axes[device.direction] for device in devices]
        return modes, np.array(chosen) / (2.0 * np.pi)

    def install_dampers(self) -> None:
        """Install the dampers, which carry none of the loads that act before."""
        self.analysis.install_dampers()

    def apply_gravity(self, channels: Sequence[Channel] = ()) -> Response:
        """Apply the gravity combination, which stays on, and record channels.

        Args:
            channels: what is recorded.

        Returns:
            The response; it is complete.

        Raises:
            AnalysisError: no equilibrium was found under it.
        """
        response = self.analysis.static(self.frame.gravity, factor=1.0, steps=GRAVITY_STEPS, channels=channels)
        if response.status != "completed":
            raise AnalysisError(no_equilibrium(response))
        if not response.finite:
            raise AnalysisError("under the gravity loads: a result is not a finite number [E-GRAV-01]")
        return response


def no_equilibrium(response: Response) -> str:
    """Return why the gravity loads find no equilibrium.

    Args:
        response: to them, which is not complete.
    """
    return f"under the gravity loads: {response.reason.partition(' [E-')[0]} [E-GRAV-01]"


def build(project: AnalysisFile, eccentricity: tuple[float, float] = IN_PLACE, **more: Any) -> FrameModel:
    """Build the model of a plane frame or of a building: the one place in studies that asks which of them it is.

    Args:
        eccentricity: of the masses of a building; see `build_building`.
        more: arguments of `build_frame`.

    Raises:
        InputError, CoreError: as `build_frame` and `build_building`.
    """
    if isinstance(project, Building):
        return build_building(project, eccentricity=eccentricity, **more)
    assert isinstance(project, Project)
    return build_frame(project, **more)


def frame_alone(
    project: AnalysisFile, dampers: bool = True, fixed_base: bool = False, eccentricity: tuple[float, float] = IN_PLACE
) -> Structure:
    """Build the frame without tuned masses and dampers, whose modes determine damping, lateral forces and periods.

    Args:
        dampers: whether it has its dampers, of which buckling-restrained braces and isolators are part of the frame.
            Other dampers of the law of an isolator stand in the model and act neither in modes nor under gravity.
        fixed_base: whether an isolated base is fixed horizontally, in place of its isolators.
        eccentricity: of the masses of a building; see `build_building`.

    Raises:
        InputError, CoreError: as `make_structure`.
    """
    laws = device_laws(project) if dampers else {}
    isolation = project.isolation if dampers and not fixed_base else None
    base = {item.law for item in (*isolation.isolators, *isolation.beside)} if isolation is not None else set()
    kept = {name: law for name, law in laws.items() if law.restrained is not None or name in base}
    weights = None if isolation is None else _weights_on_isolators(project, kept)
    laws_kept = kept if fixed_base else kept or None
    return make_structure(project, build(project, eccentricity, laws=laws_kept, weights=weights))


def elastic_frame(
    project: AnalysisFile, dampers: bool = True, eccentricity: tuple[float, float] = IN_PLACE
) -> Structure:
    """Build the frame and all dampers, without tuned masses; arguments and errors as `frame_alone`."""
    return make_structure(project, build(project, eccentricity, laws=device_laws(project) if dampers else None))


def tolerance(project: AnalysisFile) -> float:
    """Return the dimensionless tolerance of equilibrium of a project."""
    return project.integration.tolerance if project.integration is not None else DEFAULT_TOLERANCE


def device_stiffness(device: Device, amplitude: float, frequency: float) -> complex:
    """Return the complex stiffness of a device with its brace in steady vibration, N/m.

    The real part is that of the first harmonic; on an isolated base it is the effective stiffness of codes.

    Args:
        device: the damper or isolator.
        amplitude: of the deformation of device and brace, m.
        frequency: Hz.
    """
    scale = device.force_scale * device.deformation_scale
    amplitude *= device.deformation_scale
    play = device.play * device.deformation_scale
    if device.column_base:
        stiffness, work = effective_stiffness(device.values, amplitude, frequency)
        return scale * complex(stiffness, work / (np.pi * amplitude**2))
    return scale * complex_stiffness(device.values, amplitude, frequency, device.brace / scale, play)


def make_frame(
    project: AnalysisFile,
    dampers: bool = False,
    outside: Collection[str] = (),
    eccentricity: tuple[float, float] = IN_PLACE,
    model: Model | None = None,
) -> FrameModel:
    """Build a project's frame, with its dampers, isolators and tuned masses or without.

    Args:
        dampers: whether it has them.
        outside: names of dampers that are left out.
        eccentricity: of the masses of a building; see `build_building`.
        model: an empty model to build in; a new one by default.

    Raises:
        InputError: the frame cannot be built, or a damper is wrong.
    """
    if not dampers or project.dampers is None:
        return build(project, eccentricity, model=model)
    laws = device_laws(project)
    weights = {} if project.isolation is None else _weights_on_isolators(project, laws)
    more = {"attachments": attachments(project), "outside": outside, "weights": weights, "model": model}
    return build(project, eccentricity, laws=laws, **more)


def _weights_on_isolators(project: AnalysisFile, laws: Mapping[str, DeviceLaw]) -> dict[str, float]:
    """Return the weight under the gravity combination on each isolator whose forces depend on it.

    The base is fixed horizontally for it.

    Args:
        project: the project with an isolated base.
        laws: the laws of its dampers and isolators, by name.

    Returns:
        N, by name of the column base.

    Raises:
        InputError: the frame cannot be built.
        AnalysisError: no equilibrium was found.
    """
    isolation = project.isolation
    assert isolation is not None
    bases = [
        project.grid.node_name(line, 0)
        for line in project.grid.lines
        if (isolator := isolator_under(isolation, line, project.grid)) is not None
        and goes_with_weight(isolator, laws[isolator.law])
    ]
    if not bases:
        return {}
    frame = build(project, laws=laws)
    structure = make_structure(project, frame)
    channels = [Channel(base, frame.reaction(base, frame.up)) for base in bases if base in frame.supports]
    return dict(structure.apply_gravity(channels).final)


def make_structure(
    project: AnalysisFile,
    frame: FrameModel | None = None,
    dampers: bool = False,
    eccentricity: tuple[float, float] = IN_PLACE,
) -> Structure:
    """Build a project's frame and the analysis of it.

    Args:
        frame: its model, if it has been built and completed by further loads.
        dampers: whether the frame has its dampers and tuned masses.
        eccentricity: of the masses of a building; see `build_building`.

    Raises:
        InputError: the frame cannot be built.
        CoreError: it is a mechanism, or parts are not connected; the message names them.
    """
    if frame is None:
        frame = make_frame(project, dampers, eccentricity=eccentricity)
    try:
        analysis = Analysis(frame.model, tolerance=tolerance(project))
    except CoreError as error:
        if frame.isolated is None:
            raise
        why, _ = split_code(str(error))
        text = f"{why} (isolators must have a stiffness at rest that holds the base under gravity)"
        raise CoreError(error.status, text) from error
    return Structure(frame, analysis)
