# The examples of README.md print what it says. After a change on purpose: the same line with --update before README.md.
ln -s "$SAMPLES" samples
python3 "$ROOT/tests/run_examples.py" "$ROOT/README.md"
