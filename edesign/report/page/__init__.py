"""The sections of reports, each made from an archive or a calibration."""
