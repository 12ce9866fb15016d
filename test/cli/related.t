Programs for related systems: each is right, and what the explorer finds with all faults is in the table of their
README. Their logs are in examples/related/golden. Those that take longer are explored by `scripts/nightly related`.

  $ cd ../../examples/related
  $ for f in *.dol; do
  >   dolphin check "$f" > checked 2>&1 || cat checked
  >   grep -q "\`${f%.dol}\`" README.md || echo "README.md lacks $f"
  > done
  $ slow='buzz_swarms karma_pollination simbeeotic_sortie voltron_mosaic'
  $ ../../scripts/related $(ls *.dol | sed 's/\.dol$//' | grep -vxF "$(printf '%s\n' $slow)")
  aerostack2_inspection: 2,138 | holds
  bt_battery: 52 | termination violated
  bt_door: 36 | holds
  buzz_barrier: 136,488 | holds
  crazyswarm_formation: 172 | holds
  csl_river: 7,467 | holds
  dronekit_guided: 19 | holds
  flexbe_autonomy: 26 | holds
  meld_walk: 35 | no unhandled error violated
  moos_alpha: 63 | holds
  moos_berta: 236 | holds
  nav2_docking: 171 | holds
  nav2_recovery: 69 | holds
  nav2_waypoints: 234 | holds
  nvl_rendezvous: 115 | holds
  plansys2_assembly: 10,861 | holds
  plansys2_patrol: 51 | holds
  protelis_crowd: 668 | holds
  proto_gradient: 20,065 | holds
  qgc_survey: 66 | holds
  rmf_cleaning: 2,734 | holds
  rmf_delivery: 480 | holds
  rmf_lift: 43 | no deadlock violated
  robochart_chemical: 60 | holds
  skybrush_show: 477 | holds
  swarmorph_line: 7,934 | holds
  tecola_escort: 1,182 | holds
  voltron_plume: 382 | holds
  28 programs explored
