"""Part programs as text: encodings, tape and archive formats, directories, search paths."""
