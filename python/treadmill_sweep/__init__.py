"""Searches hyperparameters of `treadmill train` with Optuna, which proposes settings and ends hopeless trials."""
