"""Rigs identified from records: accuracy against the rig that made them, refusals, files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from edesign.cli.main import main
from edesign.damper.testing import signals
from edesign.errors import InputError
from edesign.project.substructure.loader import read_rig_file
from edesign.report.substructure.identified_rig_tables import identified_rig_tables
from edesign.substructure.compensation.alpha_fit import fitted_alpha
from edesign.substructure.judgement.measured import read_measured
from edesign.substructure.laboratory import rig_transfer
from edesign.substructure.rig import rigs
from edesign.substructure.rig.identified import rig_data, rig_file_text
from edesign.substructure.rig.identify import ACCURACY, identify
from edesign.substructure.rig.rig_response import rig_response
from edesign.substructure.rig.rigs import RigTransfer
from edesign.substructure.rig.uncertainty import transfer_deviations

STEP = 2e-3
THESIS = rigs.second_order(21.4, 0.4, 4.25e-3, 0.99488)


def command(duration: float = 60.0, seed: int = 3, step: float = STEP) -> tuple[np.ndarray, np.ndarray]:
    """White noise of 0.1 to 5 Hz, 5.5 mm, as thesis 6.2.4."""
    return signals.random(duration, (0.1, 5.0), seed, peak=5.5e-3, sampling_rate=1.0 / step)


def write(path: Path, time: np.ndarray, u: np.ndarray, x: np.ndarray, headers: str = "") -> Path:
    titles = headers or "time_s,command_mm,displacement_mm"
    table = np.column_stack([time, 1e3 * u, 1e3 * x])
    np.savetxt(path, table, delimiter=",", header=titles, comments="", fmt="%.10g")
    return path


def record(path: Path, transfer: RigTransfer, duration: float = 15.0, seed: int = 3) -> Path:
    """A record of a rig with noise of 1 % of the command's deviation."""
    time, u = command(duration, seed)
    shaken = 0.01 * np.std(u) * np.random.default_rng(seed).standard_normal(u.size)
    return write(path, time, u, rig_response(transfer, u, STEP) + shaken)


@pytest.mark.parametrize("transfer", [rigs.pure_delay(0.0123), rigs.first_order(0.004, 0.0063), THESIS])
def test_the_response_is_that_of_many_sub_steps(transfer: RigTransfer) -> None:
    """Exact for a command that is linear between samples: another step inside changes nothing but rounding."""
    time, u = command(4.0)
    fine = np.linspace(time[0], time[-1], 10 * (time.size - 1) + 1)
    exact = rig_response(transfer, np.interp(fine, time, u), STEP / 10.0)[::10]
    np.testing.assert_allclose(rig_response(transfer, u, STEP), exact, atol=1e-9 * np.max(np.abs(u)))


def test_the_response_to_a_sine_is_that_of_the_transfer_function() -> None:
    # the command is linear between 250 samples of a cycle: (w h)^2 / 12 = 5e-5 of it
    time, w = STEP * np.arange(4000), 2.0 * np.pi * 2.0
    found = rig_response(THESIS, np.sin(w * time), STEP)
    exact = np.imag(THESIS(np.array([1j * w]))[0] * np.exp(1j * w * time))
    np.testing.assert_allclose(found[500:], exact[500:], atol=1e-4)


@pytest.mark.parametrize("factor", [1.0 / 25.4, 2.54, 1000.0])
def test_a_gain_of_two_units_is_refused(tmp_path: Path, factor: float) -> None:
    """A header in inches above millimetres, an inch for a centimetre, metres for millimetres."""
    time, u = command(15.0, 3)
    with pytest.raises(InputError, match=r"displacement is [\d.]+ times .*E-RIG-02"):
        identify(write(tmp_path / "open_loop.csv", time, u, factor * rig_response(THESIS, u, STEP)))


@pytest.mark.parametrize(
    ("transfer", "order"), [(rigs.pure_delay(0.0102), 0), (rigs.first_order(0.004, 0.006), 1), (THESIS, 2)]
)
def test_a_rig_is_found_in_white_noise_within_its_bar(tmp_path: Path, transfer: RigTransfer, order: int) -> None:
    """0.2 ms of delay and 10 % of frequency at 1 % of noise from 60 s, and the order of the rig."""
    found = identify(record(tmp_path / "open_loop.csv", transfer, 60.0))
    chosen = found.chosen
    assert chosen.order == order
    assert chosen.low_frequency_delay.value == pytest.approx(transfer.low_frequency_delay, abs=0.2 * ACCURACY)
    assert chosen.parameters["delay"].value == pytest.approx(transfer.delay, abs=2.0 * ACCURACY)
    assert chosen.parameters["gain"].value == pytest.approx(transfer.gain, abs=1e-3)
    assert chosen.left == pytest.approx(0.01, rel=0.05)
    assert chosen.independent > 0.9
    if order == 2:
        assert chosen.parameters["frequency"].value == pytest.approx(21.4, rel=0.1)
        assert chosen.parameters["damping"].value == pytest.approx(0.4, rel=0.1)


def test_standard_errors_are_those_of_records_with_other_noise(tmp_path: Path) -> None:
    """Of eight records: a deviation within a factor of two of the true one with 98 % (chi-square of 7)."""
    found = [identify(record(tmp_path / "one.csv", THESIS, seed=seed), 2).chosen for seed in range(8)]
    for name in ("delay", "frequency", "damping", "gain"):
        scatter = float(np.std([fit.parameters[name].value for fit in found], ddof=1))
        reported = float(np.mean([fit.parameters[name].standard_error for fit in found]))
        assert 0.5 < scatter / reported < 2.0, name


def test_an_order_may_be_asked_for(tmp_path: Path) -> None:
    found = identify(record(tmp_path / "open_loop.csv", THESIS), 0)
    assert found.chosen.order == 0 and "as asked for" in found.why
    assert found.chosen.independent < 0.5 and "not white noise" in found.notes[0]
    with pytest.raises(InputError, match="order: .*E-VALUE-02"):
        identify(tmp_path / "open_loop.csv", 3)


@pytest.mark.parametrize("rig", [THESIS, rigs.pure_delay(0.01)], ids=["second order", "delay"])
@pytest.mark.parametrize("step", [0.5e-3, 1e-3, 2e-3])
def test_alpha_of_a_record_is_that_of_the_inverse_rig(rig: RigTransfer, step: float) -> None:
    """Closed form of the least squares: the inverse rig over i omega against alpha_0 + alpha_1 D + alpha_2 D^2, with
    D = (1 - exp(-i omega T))/T = i omega + omega^2 T/2 - ..., by real and imaginary parts.

    The imaginary part gives alpha_1 = a_1 - (a_3 + T alpha_2) m_4/m_2, the real one alpha_2 = a_2 + alpha_1 T/2. A
    command that is linear between samples has 1 - (omega T)^2/12 of its amplitude, which is T^2/12 of alpha_2. Higher
    terms are left out: of alpha_1 the part (omega a_1)^2 of its loss, 10 % at 5 Hz; of alpha_2 up to a_4 omega^2.
    """
    t, u = command(step=step)
    x = rig_response(rig, u, step)
    a0, a1, a2 = fitted_alpha(u, x, step)
    exact = rig.inverse_series(4)
    omega, density = 2.0 * np.pi * np.fft.rfftfreq(t.size, step), np.abs(np.fft.rfft(x)) ** 2
    moments = float(np.sum(omega**4 * density) / np.sum(omega**2 * density))
    loss = (exact[3] + step * a2) * moments
    assert a0 == pytest.approx(exact[0], abs=1e-3)
    assert a1 == pytest.approx(exact[1] - loss, abs=0.1 * loss)
    expected = exact[2] + 0.5 * step * a1 - step**2 / 12.0
    assert a2 == pytest.approx(expected, abs=abs(exact[4]) * (2.0 * np.pi * 5.0) ** 2)


def test_the_rig_file_is_read_as_the_same_rig(tmp_path: Path) -> None:
    source = record(tmp_path / "open_loop.csv", THESIS)
    path = tmp_path / "rig.yaml"
    assert main(["rts", "identify", str(source), "--output", str(path)]) == 0
    found, file = identify(source), read_rig_file(path)
    assert rig_transfer(file.rig, 0.0).low_frequency_delay == pytest.approx(
        found.chosen.low_frequency_delay.value, rel=1e-4
    )
    assert file.encoder_noise == pytest.approx(found.chosen.noise, rel=1e-4)
    assert file.alpha == pytest.approx(found.alpha, rel=1e-4)
    assert "frequency" in file.standard_errors and "open_loop.csv" in file.source
    assert (
        main(["rts", "identify", str(source), "--order", "0", "--output", str(path)]) == 0
    )  # its own file is replaced
    path.write_text("rig: {kind: ideal}\n")
    assert main(["rts", "identify", str(source), "--order", "0", "--output", str(path)]) == 2
    assert rig_data(found)["rig"]["kind"] == "second_order"
    assert rig_file_text(found).startswith("rig: {kind: second_order")


def _still(t: np.ndarray, u: np.ndarray, x: np.ndarray) -> tuple[np.ndarray, ...]:
    return t, u, 0.0 * x


def _short(t: np.ndarray, u: np.ndarray, x: np.ndarray) -> tuple[np.ndarray, ...]:
    return t[:200], u[3000:3200], x[3000:3200]


def _swapped(t: np.ndarray, u: np.ndarray, x: np.ndarray) -> tuple[np.ndarray, ...]:
    return t, x, u


def _shifted(t: np.ndarray, u: np.ndarray, x: np.ndarray) -> tuple[np.ndarray, ...]:
    return t, u, np.interp(t - 2.0, t, x)


def _opposite(t: np.ndarray, u: np.ndarray, x: np.ndarray) -> tuple[np.ndarray, ...]:
    return t, u, -x


def _clipped(t: np.ndarray, u: np.ndarray, x: np.ndarray) -> tuple[np.ndarray, ...]:
    return t, u, np.minimum(x, 0.7 * np.max(x))


def _two_clocks(t: np.ndarray, u: np.ndarray, x: np.ndarray) -> tuple[np.ndarray, ...]:
    return t, u, np.interp(t * (1.0 - 2e-5), t, x)  # 1.2 ms in 60 s


def _far_apart(t: np.ndarray, u: np.ndarray, x: np.ndarray) -> tuple[np.ndarray, ...]:
    return t, u, np.interp(t * (1.0 - 3e-3), t, x)


def _gap(t: np.ndarray, u: np.ndarray, x: np.ndarray) -> tuple[np.ndarray, ...]:
    return tuple(np.delete(one, 1234) for one in (t, u, x))


def _unrelated(t: np.ndarray, u: np.ndarray, x: np.ndarray) -> tuple[np.ndarray, ...]:
    return t, u, command(seed=99)[1]


@pytest.mark.parametrize(
    ("spoilt", "says"),
    [
        (_still, "displacement .*E-MEAS-03"),
        (_short, "0.398 s .* 0.804 s .*E-RIG-01"),
        (_swapped, "command by 10.*E-RIG-02"),
        (_shifted, r"2\.01 s late.*E-RIG-02"),
        (_opposite, "opposite sign.*E-RIG-02"),
        (_clipped, r"3\.8\d+ mm.*E-MEAS-03"),
        (_two_clocks, "two clocks.*E-RIG-03"),
        (_far_apart, "two clocks.*E-RIG-03"),
        (_gap, "uneven"),
        (_unrelated, "correlation.*E-RIG-01"),
    ],
    ids=lambda one: getattr(one, "__name__", ""),
)
def test_a_record_that_no_rig_makes_is_refused_in_one_sentence(tmp_path: Path, spoilt, says: str) -> None:  # type: ignore[no-untyped-def]
    time, u = command()
    x = rig_response(THESIS, u, STEP) + 2e-6 * np.random.default_rng(1).standard_normal(u.size)
    path = write(tmp_path / "bad.csv", *spoilt(time, u, x))
    with pytest.raises(InputError, match=says) as refused:
        identify(path)
    assert "bad.csv" in str(refused.value) and "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("headers", "says"),
    [
        ("time_s,comand_mm,displacement_mm", "did you mean `command`"),
        ("time_s,target_mm,displacement_mm", r"bad\.csv:1: .*command_mm.*E-MEAS-01"),
        ("time_s,command_kN,displacement_mm", "bad.csv:1, column 2 .*`kN`.*E-TABLE-12"),
        ("time_s,command,displacement_mm", "bad.csv:1, column 2 .*command_mm.*E-TABLE-12"),
        ("time_s,command_mm,Command (mm)", "bad.csv:1, column 3 .*E-MEAS-01"),
    ],
)
def test_headers_are_checked(tmp_path: Path, headers: str, says: str) -> None:
    time, u = command(4.0)
    with pytest.raises(InputError, match=says):
        identify(write(tmp_path / "bad.csv", time, u, u, headers))


def test_headers_of_machines_and_other_units_are_read(tmp_path: Path) -> None:
    path = tmp_path / "machine.csv"
    lines = [f"{0.5 * k};{np.sin(0.1 * k):.6f};{0.1 * k};7" for k in range(50)]
    path.write_text("Time (ms);Encoder (cm);Load [N];Valve (V)\n" + "\n".join(lines))
    found = read_measured(path, "displacement", "force")
    assert found.step == pytest.approx(5e-4) and found.unread == ("Valve (V)",)
    assert found["displacement"][1] == pytest.approx(0.01 * np.sin(0.1), abs=1e-8)
    assert found["force"][10] == pytest.approx(1.0)


@pytest.mark.parametrize(("step", "says"), [(0.03, "not filtered, sampled at 33.3 Hz"), (0.01, "filtered at 20 Hz")])
def test_the_filter_of_the_alphas_is_reported_as_it_was(tmp_path: Path, step: float, says: str) -> None:
    """Half of 33 Hz is below its 20 Hz."""
    t, u = signals.random(60.0, (0.1, 3.0), 3, peak=5e-3, sampling_rate=1.0 / step)
    x = rig_response(rigs.pure_delay(0.05), u, step) + 1e-6 * np.random.default_rng(1).standard_normal(u.size)
    found = identify(write(tmp_path / "slow.csv", t, u, x))
    assert " ".join(identified_rig_tables(found)[-1].notes).startswith(f"least squares: {says},")


def test_the_band_of_a_slow_motion_is_that_of_gain_and_delay(tmp_path: Path) -> None:
    """At rest a rig is its gain and the delay of slow motions, whose errors the fit has from their own formulas.

    The next terms are (omega / own)^2 = 2e-7 at 0.01 Hz, and slopes over one standard error of the frequency, 2 %, are
    curved by its square.
    """
    path = tmp_path / "rig.yaml"
    source = record(tmp_path / "open_loop.csv", THESIS)
    assert main(["rts", "identify", str(source), "--output", str(path)]) == 0
    fit, file = identify(source).chosen, read_rig_file(path)
    omega = np.array([2.0 * np.pi * 0.01])
    amplitude, phase = transfer_deviations(file, omega)
    gain = fit.parameters["gain"]
    assert amplitude[0] == pytest.approx(gain.standard_error / gain.value, rel=1e-3)
    assert phase[0] / omega[0] == pytest.approx(fit.low_frequency_delay.standard_error, rel=0.02)


def test_the_band_covers_other_records(tmp_path: Path) -> None:
    """Amplitude and phase at 3 Hz of eight records: a deviation within a factor of two with 98 % (chi-square of 7)."""
    s, found, reported = np.array([6.0j * np.pi]), [], []
    path = tmp_path / "rig.yaml"
    for seed in range(8):
        fitted = identify(record(tmp_path / "one.csv", THESIS, seed=seed), 2)
        path.write_text(rig_file_text(fitted), encoding="utf-8")
        found.append(np.log(fitted.chosen.transfer(s)[0]))
        reported.append(np.ravel(transfer_deviations(read_rig_file(path), s.imag)))
    scatter = np.std(np.real(found), ddof=1), np.std(np.imag(found), ddof=1)
    ratios = np.array(scatter) / np.mean(reported, axis=0)
    assert np.all((ratios > 0.5) & (ratios < 2.0)), ratios


@pytest.mark.parametrize(
    ("covariance", "message"),
    [
        ("[[1.0]]", "covariance: .*2 x 2.*E-VALUE-04"),
        ("[[1.0, 0.5], [0.2, 1.0]]", "covariance: .*symmetric.*E-RIG-04"),
        ("[[1.0, 2.0], [2.0, 1.0]]", "covariance: .*below zero.*E-RIG-04"),
        ("[[1.0, .inf], [0.0, 1.0]]", "covariance"),
    ],
)
def test_what_is_no_covariance_is_refused(tmp_path: Path, covariance: str, message: str) -> None:
    path = tmp_path / "rig.yaml"
    text = "rig: {kind: delay, delay: 10 ms}\nstandard_errors: {delay: 0.01 ms, gain: 0.001}\n"
    path.write_text(f"{text}covariance: {covariance}\n", encoding="utf-8")
    with pytest.raises(InputError, match=message):
        read_rig_file(path)
    path.write_text(f"{text.replace('gain', 'mass')}covariance: [[1.0, 0.0], [0.0, 1.0]]\n", encoding="utf-8")
    with pytest.raises(InputError, match=r"standard_errors\.mass: .*E-RIG-04"):
        read_rig_file(path)
