"""Code of both pages: processes, uploads, tip files, numbers with units, and texts of errors."""
