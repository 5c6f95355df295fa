"""Names of mistakes that belong to the exercises of pages 07 to 13."""
