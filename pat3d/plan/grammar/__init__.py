"""The offline reader of English: words, phrases, a ranked chart of readings, and what each adds to the scene."""
