from readme_table import SOURCE, UPSTREAM, options, table, verbs


def test_every_verb_knows_every_option_of_the_original():
    here = {" ".join(filter(None, one)): options(*one) for one in verbs()}
    assert here.keys() == UPSTREAM.keys()
    for name, known in here.items():
        assert set(UPSTREAM[name].split()) <= known.keys(), name


def test_the_readme_has_the_table():
    """Print it anew with `python tests/ros2_command/readme_table.py`."""
    assert f"\n{table()}\n" in (SOURCE / "README.md").read_text(encoding="utf-8")
