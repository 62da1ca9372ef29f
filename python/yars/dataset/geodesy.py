"""Geodesics on WGS84 for whole arrays: Vincenty, "Direct and Inverse Solutions of Geodesics on the Ellipsoid with
Application of Nested Equations", Survey Review 23 (1975). Accuracy: 1 mm, up to 2,000 km. Angles in degrees."""
import numpy as np

_MAJOR_M, _FLATTENING = 6378137.0, 1.0 / 298.257223563
_MINOR_M = _MAJOR_M * (1.0 - _FLATTENING)
_STEPS = 3  # each step gains three digits or more


def direct(latitude, longitude, azimuth, distance_m):
    """(latitude, longitude, azimuth at the end) of the point at a distance along a geodesic."""
    alpha = np.radians(azimuth)
    sin_alpha1, cos_alpha1 = np.sin(alpha), np.cos(alpha)
    tan_u1 = (1.0 - _FLATTENING) * np.tan(np.radians(latitude))
    cos_u1 = 1.0 / np.sqrt(1.0 + tan_u1 * tan_u1)
    sin_u1 = tan_u1 * cos_u1
    sigma1 = np.arctan2(tan_u1, cos_alpha1)
    sin_alpha = cos_u1 * sin_alpha1
    cos2_alpha = 1.0 - sin_alpha * sin_alpha
    u2 = cos2_alpha * (_MAJOR_M**2 - _MINOR_M**2) / _MINOR_M**2
    a = 1.0 + u2 / 16384.0 * (4096.0 + u2 * (-768.0 + u2 * (320.0 - 175.0 * u2)))
    b = u2 / 1024.0 * (256.0 + u2 * (-128.0 + u2 * (74.0 - 47.0 * u2)))
    first = sigma = np.asarray(distance_m, float) / (_MINOR_M * a)
    for _ in range(_STEPS):
        middle = np.cos(2.0 * sigma1 + sigma)
        sin_sigma, cos_sigma = np.sin(sigma), np.cos(sigma)
        sigma = first + b * sin_sigma * (middle + b / 4.0 * (
            cos_sigma * (2.0 * middle**2 - 1.0) - b / 6.0 * middle * (4.0 * sin_sigma**2 - 3.0) * (4.0 * middle**2 - 3.0)))
    sin_sigma, cos_sigma, middle = np.sin(sigma), np.cos(sigma), np.cos(2.0 * sigma1 + sigma)
    across = sin_u1 * sin_sigma - cos_u1 * cos_sigma * cos_alpha1
    latitude2 = np.arctan2(sin_u1 * cos_sigma + cos_u1 * sin_sigma * cos_alpha1,
                           (1.0 - _FLATTENING) * np.sqrt(sin_alpha**2 + across**2))
    lam = np.arctan2(sin_sigma * sin_alpha1, cos_u1 * cos_sigma - sin_u1 * sin_sigma * cos_alpha1)
    c = _FLATTENING / 16.0 * cos2_alpha * (4.0 + _FLATTENING * (4.0 - 3.0 * cos2_alpha))
    lon = lam - (1.0 - c) * _FLATTENING * sin_alpha * (
        sigma + c * sin_sigma * (middle + c * cos_sigma * (2.0 * middle**2 - 1.0)))
    return np.degrees(latitude2), wrapped(longitude + np.degrees(lon)), np.degrees(np.arctan2(sin_alpha, -across))


def offset(latitude, longitude, north_m, east_m):
    """(latitude, longitude) of a point north_m and east_m away."""
    latitude, longitude, _ = direct(latitude, longitude, np.degrees(np.arctan2(east_m, north_m)), np.hypot(north_m, east_m))
    return latitude, longitude


def wrapped(longitude):
    """[-180, 180)."""
    return (np.asarray(longitude) + 180.0) % 360.0 - 180.0
