"""Proposes settings to `treadmill sweep` with Optuna, which samples them and ends hopeless trials."""
