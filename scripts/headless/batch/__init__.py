"""Many files, one process for each, so that a crash in one of them never ends the batch.

`checks` refuses what cannot be begun, `sources` finds the files and names their results, `plan`
says what is to be written for each and by which command line, `records` remembers what is done,
`workers` runs the processes, and `run` does it all.
"""
