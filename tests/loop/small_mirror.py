"""The usual mirror camera with a quarter of its pixels, for scenarios in which pictures are not what is tested."""

CAMERA = {"format": "homeward-camera", "version": 1, "model": "hyperbolic_mirror", "width_px": 320, "height_px": 240,
          "intrinsics": {"fx_px": 299.22895, "fy_px": 299.22895, "cx_px": 159.5, "cy_px": 119.5},
          "mirror": {"a_mm": 28.095, "b_mm": 23.4125}, "valid_radius_px": [21.5, 115.5],
          "robot_from_camera": {"translation_m": [0, 0, 1.2], "rotation_wxyz": [0.70710678, 0, 0, 0.70710678]}}
