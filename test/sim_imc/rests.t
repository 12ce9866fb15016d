Plans that are stopped and go on by `rest`, with a console that is killed and resumed: flown once, as without stops.

  $ ./rests.py "$(command -v dolphin)" --short --moments 3 --seed 1 --jobs 4 --first-port 21620
  3 of 3 rests over IMC went well
