The missions of examples/missions: each is right, comes to its end on its simulated fleet, and in every run without
faults.

  $ cd ../../examples/missions
  $ for f in *.dol; do
  >   dolphin check "$f" > checked || cat checked
  >   dolphin exec "$f" --sim="${f%.dol}.fleet" > log 2>&1 || tail -1 log
  >   dolphin explore "$f" > verdicts 2> told || cat told verdicts
  >   echo "$f: $(grep -o '^[0-9]* states' verdicts), $(grep -c ': holds' verdicts) hold"
  > done
  adaptive_sampling.dol: 28 states, 5 hold
  auction.dol: 311 states, 5 hold
  barrier.dol: 126 states, 5 hold
  convoy.dol: 52 states, 5 hold
  data_mules.dol: 64 states, 5 hold
  docks.dol: 218 states, 5 hold
  leader_and_follower.dol: 29 states, 5 hold
  mine_hunting.dol: 69 states, 5 hold
  patrol.dol: 48 states, 5 hold
  relief.dol: 1132 states, 5 hold
  replacement.dol: 432 states, 5 hold
  search_and_rescue.dol: 38 states, 5 hold

  $ check-journals

A strip is done though a vehicle is lost or fails, as long as one is left: nothing ends the mission early.

  $ dolphin explore --faults fail,loss replacement.dol | grep -v 'states'
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds

Whoever comes, as long as anybody comes, and whatever fails or is lost: a time that is given ends it.

  $ dolphin explore --faults all relief.dol 2> progress.txt | grep -v 'states'
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  note: no leftover tuples: violated after 7 steps, without a fault: tuples are left when the program completes

Those among the examples that go on whatever happens: who fails, is lost or does not come. A search with whoever is
there ends well in every run.

  $ cd ..
  $ dolphin explore --faults all search.dol | grep -v 'states'
  no deadlock: holds
  termination: holds
  no unhandled error: holds
  assertions: holds
  vehicles for all tasks: holds
  note: no leftover tuples: violated after 15 steps, with 2 faults: tuples are left when the program completes

A team that replaces who is lost, a patrol of 24 hours, an AUV that samples and one with an escort come to their ends
whatever happens; they stop if their vehicles are not there.

  $ for f in replacement.dol rotation.dol sampling.dol escort.dol; do
  >   dolphin explore --faults all $f | grep 'deadlock:\|^termination:\|^assertions:'
  > done
  no deadlock: holds
  termination: holds
  assertions: holds
  no deadlock: holds
  termination: holds
  assertions: holds
  no deadlock: holds
  termination: holds
  assertions: holds
  no deadlock: holds
  termination: holds
  assertions: holds
  $ dolphin explore --faults fail,loss scarce.dol | grep 'deadlock:\|^termination:\|^vehicles'
  dolphin: by the fleet these join late: lauv-3; here they are there from the start, unless --faults has join
  no deadlock: holds
  termination: holds
  vehicles for all tasks: holds
