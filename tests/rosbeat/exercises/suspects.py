"""Whether the suspects of an exercise can be told apart by what its scenario feeds."""

from rosbeat.exercises.model import agree, equal


def assert_told_apart(fed, right, suspects, same=equal):
    """Check that each suspect differs from the right model, and from all with another mistake."""
    tracks = [(one.mistake, one.model(fed)) for one in suspects]
    for name, track in tracks:
        assert not agree(track, right(fed), same), f"{name} is right"
    for name, track in tracks:
        like = {other for other, done in tracks if agree(track, done, same)}
        assert like == {name}, like
