The console is killed at some points of a mission, and so is the adapter: nothing is doubled, and nothing is lost. Nor is
it if the journal loses its end meanwhile. `make nightly` kills each at a hundred points.

  $ python3 kills.py console 5
  5 of 5 missions went well
  $ python3 kills.py adapter 5
  5 of 5 missions went well
  $ python3 kills.py journal 8
  8 of 8 missions went well
