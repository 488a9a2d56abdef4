"""The figures: each module draws one. draw(ds) takes the Dataset of a result and returns a matplotlib Figure.

FURTHER, where a module has it: functions that draw more figures of the same result, by the ending of their files' names.
"""
