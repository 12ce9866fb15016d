On a full disk no output is lost silently: the status is 3, and the message names the output.

  $ python3 full.py ../../examples
