"""What all tests share: drawn examples are judged by what they give, never by the time that a loaded machine takes."""

from hypothesis import HealthCheck, settings

settings.register_profile("edesign", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("edesign")
