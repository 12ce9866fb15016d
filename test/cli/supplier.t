The paper's second program, with the supplier that comes with the examples.

  $ dolphin exec ../../examples/supplier.dol --supplier ../../examples/supplier.py | grep starts
     0:00  x8-02       starts photograph_pier
     2:00  x8-02       starts look_for_oil
     3:10  x8-02       starts follow_coast

Without a supplier, and with one that is not there.

  $ cat > program.dol <<'EOF'
  > v = pick { type 'UAV' }
  > supplier = getSupplier()
  > while (supplier.active()) {
  >     execute v: supplier.queue.await()
  > }
  > EOF
  $ dolphin exec program.dol
     0:00  program     picks x8-02
     0:00  program     calls getSupplier
     0:00  program     releases x8-02
     0:00  program     fails: getSupplier: no host process to call: name one with --supplier, or give the fleet a reply 'getSupplier'
  program.dol:2:12: error: getSupplier: no host process to call: name one with --supplier, or give the fleet a reply 'getSupplier'
    2 | supplier = getSupplier()
      |            ^^^^^^^^^^^^^
  [1]
  $ dolphin exec program.dol --supplier ./missing.py 2>&1 | grep -v 'missing.py:'
     0:00  program     picks x8-02
     0:00  program     calls getSupplier
     0:00  program     releases x8-02
     0:00  program     fails: getSupplier: the host process ended with exit status 127
  program.dol:2:12: error: getSupplier: the host process ended with exit status 127
    2 | supplier = getSupplier()
      |            ^^^^^^^^^^^^^

Suppliers that die, hang or talk nonsense end the program, at the place of the call; vehicles are released.

  $ for how in 'dies at once' 'dies' 'hangs' 'talks nonsense' 'mixes up requests' 'refuses' 'hangs later'; do
  >   echo "--- $how"
  >   dolphin exec program.dol --supplier "python3 suppliers.py '$how'" --supplier-timeout 2
  >   echo "status $?"
  > done
  --- dies at once
     0:00  program     picks x8-02
     0:00  program     calls getSupplier
     0:00  program     releases x8-02
     0:00  program     fails: getSupplier: the host process ended with exit status 3
  program.dol:2:12: error: getSupplier: the host process ended with exit status 3
    2 | supplier = getSupplier()
      |            ^^^^^^^^^^^^^
  status 1
  --- dies
     0:00  program     picks x8-02
     0:00  program     calls getSupplier
     0:00  program     is told host object supplier
     0:00  program     calls supplier.active
     0:00  program     releases x8-02
     0:00  program     fails: supplier.active: the host process ended with exit status 4
  program.dol:3:8: error: supplier.active: the host process ended with exit status 4
    3 | while (supplier.active()) {
      |        ^^^^^^^^^^^^^^^^^
  status 1
  --- hangs
     0:00  program     picks x8-02
     0:00  program     calls getSupplier
     0:00  program     is told host object supplier
     0:00  program     calls supplier.active
     0:00  program     releases x8-02
     0:00  program     fails: supplier.active: the host process did not reply within 2 seconds
  program.dol:3:8: error: supplier.active: the host process did not reply within 2 seconds
    3 | while (supplier.active()) {
      |        ^^^^^^^^^^^^^^^^^
  status 1
  --- talks nonsense
     0:00  program     picks x8-02
     0:00  program     calls getSupplier
     0:00  program     is told host object supplier
     0:00  program     calls supplier.active
     0:00  program     releases x8-02
     0:00  program     fails: supplier.active: the host process replied "all is well", which is not JSON: Line 1, bytes 0-11: Invalid token 'all is well'
  program.dol:3:8: error: supplier.active: the host process replied "all is well", which is not JSON: Line 1, bytes 0-11: Invalid token 'all is well'
    3 | while (supplier.active()) {
      |        ^^^^^^^^^^^^^^^^^
  status 1
  --- mixes up requests
     0:00  program     picks x8-02
     0:00  program     calls getSupplier
     0:00  program     is told host object supplier
     0:00  program     calls supplier.active
     0:00  program     releases x8-02
     0:00  program     fails: supplier.active: the host process replied "{\"id\": 9, \"value\": true}", to request 9, but request 2 is open
  program.dol:3:8: error: supplier.active: the host process replied "{\"id\": 9, \"value\": true}", to request 9, but request 2 is open
    3 | while (supplier.active()) {
      |        ^^^^^^^^^^^^^^^^^
  status 1
  --- refuses
     0:00  program     picks x8-02
     0:00  program     calls getSupplier
     0:00  program     is told host object supplier
     0:00  program     calls supplier.active
     0:00  program     releases x8-02
     0:00  program     fails: supplier.active: the queue is closed
  program.dol:3:8: error: supplier.active: the queue is closed
    3 | while (supplier.active()) {
      |        ^^^^^^^^^^^^^^^^^
  status 1
  --- hangs later
     0:00  program     picks x8-02
     0:00  program     calls getSupplier
     0:00  program     is told host object supplier
     0:00  program     calls supplier.active
     0:00  program     is told true
     0:00  program     calls supplier.queue
     0:00  program     is told host object queue
     0:00  program     calls queue.await
     0:00  program     releases x8-02
     0:00  program     fails: queue.await: the host process did not reply within 2 seconds
  program.dol:4:16: error: queue.await: the host process did not reply within 2 seconds
    4 |     execute v: supplier.queue.await()
      |                ^^^^^^^^^^^^^^^^^^^^^^
  status 1

Values there and back.

  $ cat > echo.dol <<'EOF'
  > supplier = getSupplier()
  > for (x in [1, 1.5, 'text', true, null, [1, [2]], [a: 1, 'b c': [:]], location(41, -8), 1..3, imcPlan('p')]) {
  >     message "${x} ${supplier.echo(x)}"
  > }
  > message supplier.echo({ x -> x })
  > EOF
  $ dolphin exec echo.dol --supplier "python3 suppliers.py echoes" | grep says
  echo.dol:5:9: error: supplier.echo: a closure cannot be sent to the host
    5 | message supplier.echo({ x -> x })
      |         ^^^^^^^^^^^^^^^^^^^^^^^^^
     0:00  program     says: 1 1
     0:00  program     says: 1.5 1.5
     0:00  program     says: text text
     0:00  program     says: true true
     0:00  program     says: null null
     0:00  program     says: [1, [2]] [1, [2]]
     0:00  program     says: [a:1, b c:[:]] [a:1, b c:[:]]
     0:00  program     says: (41.000000, -8.000000) (41.000000, -8.000000)
     0:00  program     says: 1..3 [1, 2, 3]
     0:00  program     says: task('p') task('p')

The programs that ran did what the semantics allows.

  $ check-journals
