"""A class of two as each platform lets an instructor download it: Ana, and Ben, who is late."""

from datetime import datetime

from grading_files import PAGE_03, PAGE_04

#: When the class is due, and when Ana and Ben handed in.
DUE = "2026-11-25 18:00"
ON_TIME, LATE = datetime(2026, 11, 25, 15, 14), datetime(2026, 11, 26, 13, 5)
METADATA = """\
---
submission_7:
  :submitters:
  - :name: Ana Muster
    :sid: '0100'
    :email: ana@example.org
  :created_at: 2026-11-25 15:14:00.123456789 Z
  :score: 0.0
submission_9:
  :submitters:
  - :name: Ben Okafor
    :sid: '0200'
    :email: ben@example.org
  :created_at: 2026-11-26 13:05:00.000000000 +00:00
"""


def _both(prefix, *files):
    names = files or ("03_write.ipynb", "04_listen.ipynb")
    return {f"{prefix}{name}": PAGE_03 if "03" in name else PAGE_04 for name in names}


def _note(name, username):
    return f"Name: {name} ({username})\nAssignment: HW_1\nDate Submitted: Wednesday\n\nComments:\n"


#: The files of a download by the name of the platform; ids of Ana and Ben.
DOWNLOADS = {
    "folder": (
        {**_both("class/ana/"), **_both("class/ben/")},
        ("ana", "ben"),
    ),
    "moodle": (
        {
            **_both("Ana Muster_100_assignsubmission_file_/"),
            **_both("Ben Okafor_200_assignsubmission_file_/"),
        },
        ("100", "200"),
    ),
    "canvas": (
        {**_both("musterana_100_9001_"), **_both("okaforben_LATE_200_9002_")},
        ("100", "200"),
    ),
    "brightspace": (
        {
            **_both("HW 1 Download/100-5005 - Ana Muster - Nov 25, 2026 314 PM/"),
            **_both("HW 1 Download/200-5005 - Ben Okafor - Nov 26, 2026 1:05 PM/"),
            "HW 1 Download/index.html": "<table><tr><td>Ana Muster</td></tr></table>",
        },
        ("100", "200"),
    ),
    "blackboard": (
        {
            **_both("HW_1_ana_attempt_2026-11-25-15-14-00_"),
            "HW_1_ana_attempt_2026-11-25-15-14-00.txt": _note("Ana Muster", "ana"),
            **_both("HW_1_b_okafor_attempt_2026-11-26-13-05-00_"),
            "HW_1_b_okafor_attempt_2026-11-26-13-05-00.txt": _note("Ben Okafor", "b_okafor"),
        },
        ("ana", "b_okafor"),
    ),
    "gradescope": (
        {
            **_both("assignment_1_export/submission_7/"),
            **_both("assignment_1_export/submission_9/"),
            "assignment_1_export/submission_metadata.yml": METADATA,
        },
        ("0100", "0200"),
    ),
}
#: A roster as each platform exports it, with a third learner; ids of all three in results.
ROSTERS = {
    "moodle": (
        'Identifier,"Full name",Status,Grade,"Maximum Grade"\n'
        '"Participant 100","Ana Muster",,,\n"Participant 200","Ben Okafor",,,\n'
        '"Participant 300","Cem Arslan",,,\n',
        ("100", "200", "300"),
    ),
    "canvas": (
        "Student,ID,SIS User ID,SIS Login ID,Section,HW 1 (77)\n    Points Possible,,,,,8\n"
        '"Muster, Ana",100,x1,ana,A,\n"Okafor, Ben",200,x2,ben,A,\n"Arslan, Cem",300,x3,cem,A,\n'
        '"Student, Test",900,,t,A,\n',
        ("100", "200", "300"),
    ),
    "brightspace": (
        "OrgDefinedId,Username,Last Name,First Name,HW 1 Points Grade <Numeric MaxPoints:8>,"
        "End-of-Line Indicator\n#71,#ana.m,Muster,Ana,,#\n#72,#ben.o,Okafor,Ben,,#\n"
        "#73,#cem.a,Arslan,Cem,,#\n",
        ("100", "200", "73"),
    ),
    "blackboard": (
        '"Last Name","First Name","Username","Student ID","Last Access","Availability",'
        '"HW 1 [Total Pts: 8 Score] |123456"\n"Muster","Ana","ana","71","","Yes",""\n'
        '"Okafor","Ben","b_okafor","72","","Yes",""\n"Arslan","Cem","cem","73","","Yes",""\n',
        ("ana", "b_okafor", "cem"),
    ),
    "gradescope": (
        "First Name,Last Name,SID,Email,Role\nAna,Muster,0100,ana@example.org,Student\n"
        "Ben,Okafor,0200,ben@example.org,Student\nCem,Arslan,,cem@example.org,Student\n",
        ("0100", "0200", "cem@example.org"),
    ),
}
