The time of day: of the fleet's date in simulated time, of the journal afterwards.

  $ cat > mission.dol <<'EOF'
  > include 'prelude'
  > auv = pick { type 'UUV' }
  > execute (idleUntil('21:30') >> task('survey'))[auv]
  > message "${timeOfDay()} s after midnight, ${timeOfDay() >= timeOfDay('22:00')}"
  > EOF
  $ cat > mission.fleet <<'EOF'
  > begins '2026-06-01 21:00'
  > zone '-03:30'
  > vehicle 'noptilus-1', { type 'UUV' }
  > plan 'survey', { duration 45.minutes }
  > EOF
  $ dolphin check mission.dol
  mission.dol: no errors
  mission.fleet: no errors
  $ dolphin exec mission.dol --journal mission.run
     0:00  program     picks noptilus-1
     0:00  program     sees that a condition holds
    30:00  program     sees that a condition holds
    30:00  noptilus-1  starts survey
  1:15:00  noptilus-1  ends survey
  1:15:00  program     says: 80100 s after midnight, true
  1:15:00  program     releases noptilus-1
  1:15:00  program     ends
  $ head -1 mission.run | grep -o '"begins":"[^"]*"'
  "begins":"2026-06-01T21:00:00-03:30"
  $ dolphin trace check mission.dol mission.run
  mission.run: a run, of 9 transitions in 1:15:00; completed

A journal whose date is none is refused.

  $ sed 's/"begins":"[^"]*"/"begins":"2026-13-01T21:00:00+01:00"/' mission.run > damaged.run
  $ dolphin trace check mission.dol damaged.run
  dolphin: damaged.run:1: "begins" is not a date such as 2026-06-01T21:30:00+01:00
  [2]

A run goes on at the date of its journal.

  $ head -n "$(grep -n 'starts\|start' mission.run | tail -1 | cut -d: -f1)" mission.run > part.run
  $ dolphin exec mission.dol --resume part.run | tail -3
  1:15:00  program     says: 80100 s after midnight, true
  1:15:00  program     releases noptilus-1
  1:15:00  program     ends
  $ dolphin exec mission.dol --resume part.run --zone UTC
  dolphin: a run goes on at the date at which it began: leave out --begins and --zone
  [2]
  $ dolphin trace check mission.dol part.run
  part.run: a run, of 9 transitions in 1:15:00; completed

--begins and --zone are instead of the fleet's.

  $ dolphin exec mission.dol --begins '2026-12-31 23:00:30' | tail -4
  23:14:30  noptilus-1  ends survey
  23:14:30  program     says: 80100 s after midnight, true
  23:14:30  program     releases noptilus-1
  23:14:30  program     ends
  $ dolphin exec mission.dol --zone=UTC --journal utc.run > log; head -1 utc.run | grep -o '"begins":"[^"]*"'
  "begins":"2026-06-01T21:00:00+00:00"
  $ dolphin exec mission.dol --begins '2026-02-29 12:00'
  dolphin: --begins: '2026-02-29 12:00' is not a date and a time of day, such as '2026-06-01 21:30'
  [2]
  $ dolphin exec mission.dol --begins '2026-02-28 24:00'
  dolphin: --begins: '24:00' is not a time of day from '00:00' to '23:59:59', such as '21:30'
  [2]
  $ dolphin exec mission.dol --zone +15:00 2>&1 | head -2
  dolphin: option '--zone': '+15:00' is not a time zone: write 'UTC', or an
           offset from UTC of at most 14 hours, such as '+01:00'

Without a date there is no time of day.

  $ sed 1,2d mission.fleet > undated.fleet
  $ dolphin exec mission.dol --fleet undated.fleet
  dolphin: mission.dol: it reads the time of day: give --begins '2026-06-01 21:00', or write in the fleet: begins '2026-06-01 21:00'
  [2]
  $ dolphin time mission.dol --fleet undated.fleet > result; sed 's/, [0-9.]* s, [0-9]* MiB//' result
  inconclusive: mission.dol:3:10: now() or timeOfDay() is used other than in comparisons with constants, or the fleet does not have the date at which the run begins: the effect of the date on time is unknown here; times are of the runs until then
  2 states, depth 0
  $ dolphin exec mission.dol --fleet undated.fleet --begins '2026-06-01 21:30' | tail -4
  24:45:00  noptilus-1  ends survey
  24:45:00  program     says: 80100 s after midnight, true
  24:45:00  program     releases noptilus-1
  24:45:00  program     ends

Texts that are not times of day.

  $ cat > wrong.dol <<'EOF'
  > message timeOfDay('25:00')
  > message timeOfDay('9:30')
  > message timeOfDay(930)
  > message timeOfDay('09:30', '10:30')
  > EOF
  $ dolphin check wrong.dol
  wrong.dol:1:9: error: '25:00' is not a time of day from '00:00' to '23:59:59', such as '21:30'
    1 | message timeOfDay('25:00')
      |         ^^^^^^^^^^^^^^^^^^
  wrong.dol:2:9: error: '9:30' is not a time of day from '00:00' to '23:59:59', such as '21:30'
    2 | message timeOfDay('9:30')
      |         ^^^^^^^^^^^^^^^^^
  wrong.dol:3:19: error: timeOfDay takes a string, this is a number
    3 | message timeOfDay(930)
      |                   ^^^
  wrong.dol:4:9: error: timeOfDay takes 0 to 1 arguments, not 2
    4 | message timeOfDay('09:30', '10:30')
      |         ^^^^^^^^^^^^^^^^^^^^^^^^^^^
  wrong.dol: 4 errors
  [2]
  $ cat > text.dol <<'EOF'
  > text = '24' + ':00'
  > message timeOfDay(text)
  > EOF
  $ dolphin exec text.dol
     0:00  program     fails: '24:00' is not a time of day from '00:00' to '23:59:59', such as '21:30'
  text.dol:2:9: error: '24:00' is not a time of day from '00:00' to '23:59:59', such as '21:30'
    2 | message timeOfDay(text)
      |         ^^^^^^^^^^^^^^^
  [1]
  $ cat > wrong.fleet <<'EOF'
  > begins '2026-13-01 21:00'
  > begins 5
  > zone 'CET'
  > zone 'UTC'
  > zone 'UTC'
  > EOF
  $ dolphin check mission.dol --fleet wrong.fleet
  wrong.fleet:1:8: error: '2026-13-01 21:00' is not a date and a time of day, such as '2026-06-01 21:30'
    1 | begins '2026-13-01 21:00'
      |        ^^^^^^^^^^^^^^^^^^
  wrong.fleet:2:1: error: begins takes the date at which runs begin, as in begins '2026-06-01 21:00'
    2 | begins 5
      | ^^^^^^
  wrong.fleet:3:6: error: 'CET' is not a time zone: write 'UTC', or an offset from UTC of at most 14 hours, such as '+01:00'
    3 | zone 'CET'
      |      ^^^^^
  wrong.fleet:5:1: error: zone stands twice
    5 | zone 'UTC'
      | ^^^^
  wrong.fleet: 4 errors
  mission.dol: no errors
  [2]

Day after day is a finite state space: the time analysis sees that the mission never ends, and each survey.

  $ cat > daily.dol <<'EOF'
  > include 'prelude'
  > auv = pick { type 'UUV' }
  > execute daily('06:00', task('survey') during 30.minutes)[auv]
  > EOF
  $ dolphin time daily.dol --fleet mission.fleet > result; sed 's/, [0-9.]* s, [0-9]* MiB//' result
  no run ends
  task    vehicle     starts            stopped           where
  survey  noptilus-1  9:00:00 or later  9:30:00 or later  daily.dol:3
  45 states, depth 25
  
  a run that may never end:
      program                        noptilus-1     where        variables
  1   pick(1 vehicle of type 'UUV')                 daily.dol:2
  2   picks noptilus-1                              daily.dol:2
  3   execute                                       daily.dol:3  auv = noptilus-1
  4   check                                         daily.dol:3
  5   check                                         daily.dol:3
  6                                  starts survey  daily.dol:3
  7   timeout                                       daily.dol:3
  8   check                                         daily.dol:3
  and from there, again and again:
       program  noptilus-1     where
   9   check                   daily.dol:3
  10            starts survey  daily.dol:3
  11   timeout                 daily.dol:3
  12   check                   daily.dol:3
  it goes round in the repeat at daily.dol:3:9
  $ dolphin explore daily.dol --fleet mission.fleet > result; sed 's/, [0-9.]* s, [0-9]* MiB//' result
  no deadlock: holds
  termination: by design not: repeat at daily.dol:3:9; ended by nothing that may happen here
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  7 states, 9 transitions, depth 6; reduced by partial order
