"""`python -m polycnc`."""

try:
    from polycnc.cli import main

    main()
except KeyboardInterrupt:  # before there was anything that could answer
    raise SystemExit(130) from None
