"""Tables as people's spreadsheets and editors save them."""

import codecs

import pytest

from rosbeat.grading.sheets import Row, read_sheet

COLUMNS = ("exercise", "points")
ROWS = [{"exercise": "03a", "points": "4"}, {"exercise": "04", "points": "1,5"}]


def cells(data):
    return [row.cells for row in read_sheet(data, COLUMNS).rows]


@pytest.mark.parametrize(
    "text",
    [
        'exercise,points\n03a,4\n04,"1,5"\n',
        'exercise,points\n03a,4\n04,"1,5"',
        'exercise,points\r\n03a,4\r\n04,"1,5"\r\n',
        'exercise,points\r03a,4\r04,"1,5"\r',
        "exercise;points\n03a;4\n04;1,5\n",
        "exercise\tpoints\n03a\t4\n04\t1,5\n",
        '"exercise";"points"\n"03a";"4"\n"04";"1,5"\n',
        "sep=;\nexercise;points\n03a;4\n04;1,5\n",
        " Exercise ; POINTS \n 03a ; 4 \n 04 ; 1,5 \n",
        "\n\nexercise;points\n\n03a;4\n;\n04;1,5\n\n",
        "points;exercise\n4;03a\n1,5;04\n",
        "03a;4\n04;1,5\n",
        '03a,4\n04,"1,5"\n',
        "exercise;points\n03a;\x004\n04;1,5\n",
        "exercise,points\n03a,4\n04,1,5\n",
    ],
)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "cp1252"])
def test_every_dialect_is_read_the_same(text, encoding):
    assert cells(text.encode(encoding)) == ROWS


def test_umlauts_of_old_and_new_files_are_read():
    text = "exercise;points\nMüller ß€;1\n"
    wanted = [{"exercise": "Müller ß€", "points": "1"}]
    assert cells(text.encode("cp1252")) == wanted
    assert cells(text.encode()) == wanted
    assert cells(codecs.BOM_UTF16_BE + text.encode("utf-16-be")) == wanted


def test_other_columns_are_kept_by_their_names():
    sheet = read_sheet(b"why,points,exercise\nso,2,03a\n", COLUMNS)
    assert sheet.header == ("why", "points", "exercise")
    assert sheet.rows == (Row(2, {"why": "so", "points": "2", "exercise": "03a"}),)


def test_a_row_that_is_too_short_has_fewer_cells():
    assert cells(b"exercise,points\n03a\n") == [{"exercise": "03a", "points": ""}]
    assert cells(b"exercise,points,why\n03a\n")[0].get("why", "") == ""


def test_a_line_break_in_quotes_belongs_to_its_cell_and_lines_are_counted():
    sheet = read_sheet(b'exercise,points\n"a\nb",1\nc,2\n', COLUMNS)
    assert sheet.rows == (
        Row(2, {"exercise": "a\nb", "points": "1"}),
        Row(4, {"exercise": "c", "points": "2"}),
    )
    assert sheet.problems == ()


def test_a_quotation_mark_that_nobody_closed_costs_no_other_line():
    sheet = read_sheet(b'exercise,points\n03a,"4\n04,5\n05,6\n', COLUMNS)
    assert [row.cells["exercise"] for row in sheet.rows] == ["03a", "04", "05"]
    assert [row.cells["points"] for row in sheet.rows] == ["4", "5", "6"]
    assert [line for line, _ in sheet.problems] == [2]


def test_a_cell_of_a_million_characters_costs_no_other_line():
    sheet = read_sheet(b"exercise,points\n" + b"x" * 1_000_000 + b",1\n04,5\n", COLUMNS)
    assert [row.cells for row in sheet.rows] == [{"exercise": "04", "points": "5"}]
    assert [line for line, _ in sheet.problems] == [2]


@pytest.mark.parametrize(
    "data", [b"", b"\n", b"\0", b"\xef\xbb\xbf", b"\xff\xfe", b"sep=;\n", b";;\n"]
)
def test_nothing_is_nothing(data):
    assert cells(data) == []


@pytest.mark.parametrize("data", [b"\x89PNG\r\n\x1a\n\0\0", bytes(range(256)) * 50, b'"' * 999])
def test_what_is_no_table_raises_nothing(data):
    read_sheet(data, COLUMNS)
