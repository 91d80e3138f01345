//! Results out: Parquet telemetry, summary, the HTML report.
