import sys
from pathlib import Path

# answers.py is a bank of learners' classes, imported by name in this folder's tests.
sys.path.insert(0, str(Path(__file__).parent))
