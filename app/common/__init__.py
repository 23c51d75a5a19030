"""What both pages use: processes, files of tips and their parts, numbers with units, texts of errors."""
