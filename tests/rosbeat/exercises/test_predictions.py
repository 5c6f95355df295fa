import pytest

from rosbeat import predict

BECAUSE = "The first one comes after a full period."


def test_without_a_prediction_it_says_what_happened_and_not_why():
    prediction = predict("____", 63, because=BECAUSE)
    assert str(prediction) == "○ No prediction yet. It was 63."
    assert not prediction.was_right


def test_a_right_one():
    prediction = predict("63", 63)
    assert str(prediction) == "✓ You predicted 63, and it was 63."
    assert prediction.was_right


def test_another_one_is_not_blamed():
    assert str(predict(60, 63)) == "✗ You predicted 60, and it was 63. Look at why."


def test_a_near_one_is_said_to_be_near():
    near = predict(60, 63, tolerance=5)
    assert str(near) == "✓ You predicted 60, and it was 63. That is close enough."


@pytest.mark.parametrize("guess", [60, 63])
def test_the_reason_is_given_whether_it_was_right_or_not(guess):
    prediction = predict(guess, 63, because=BECAUSE)
    assert str(prediction).endswith(f"\n  {BECAUSE}")
    assert BECAUSE in prediction.html()


def test_two_that_look_alike_show_all_their_digits():
    assert "predicted 22.3, and it was 22.30003." in str(predict(22.3, 22.30003))
    assert "predicted 1.0000001, and it was 1.0000023." in str(predict(1.0000001, 1.0000023))


def test_odd_guesses_never_end_the_page():
    for guess in (object(), [], {}, len, predict, b"x"):
        assert str(predict(guess, 63, tolerance="wide", because=3)).startswith("○ ")
        assert str(predict(guess, "High", tolerance="wide", because=3)).startswith("✗ ")
    assert str(predict(float("nan"), 63)).startswith("✗ ")


def test_what_cannot_be_compared_is_no_wrong_prediction():
    prediction = predict("?", 63, because=BECAUSE)
    assert str(prediction) == "○ That cannot be compared with 63: write a number."
    assert str(predict("?", False)) == "○ That cannot be compared with no: write yes or no."
    assert not prediction.was_right


def test_a_guess_in_words_is_told_as_it_was_written():
    assert str(predict("20-30", 26)) == "✓ You predicted 20-30, and it was 26."
    near = predict("about 60", 63, tolerance=5)
    assert str(near) == "✓ You predicted about 60, and it was 63. That is close enough."


def test_text_and_html_say_the_same_and_are_the_same_every_time():
    bundle = predict("<b>", object())._repr_mimebundle_()
    assert bundle == predict("<b>", object())._repr_mimebundle_()
    assert "&lt;b&gt;" in bundle["text/html"]
    assert bundle["text/plain"] == repr(predict("<b>", object()))
