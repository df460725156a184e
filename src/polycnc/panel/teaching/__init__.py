"""What a teacher does with a control: faults, exercises, records of a session. Nothing here knows a browser.

faults     faults that are put into a machine; `faults.toml` beside it has them
exercise   an exercise as a file: texts, faults and checks
lesson     an exercise under way, and its result sheet
recording  what an operator has done, and doing it again
"""
