"""What the word-address controls share: plans of blocks, words, and the handlers of common codes."""
