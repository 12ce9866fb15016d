The transcript in the README is that of the mission.

  $ sed -n '/^\$ dolphin exec/,/^```/p' ../../README.md | sed '1d; $d' | diff - ../../examples/golden/rendezvous.log
