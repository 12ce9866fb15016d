(* Programs that an unsound reduction would get wrong, each with its expected verdict; and programs that must be
   reduced. *)

open Dolphin_environment
module Pure_run = Test_support.Pure_run
module Search = Dolphin_explore.Search

let world = Test_support.Generate.world

let picks = {|a = pick { id 'a' }
b = pick { id 'b' }
c = pick { id 'c' }
|}

let plain = Environment.default
let failing = Environment.failing plain

(* [x: 1] may be posted once, at any time. *)
let posting = { plain with inputs = Test_support.Posts.once }

let check ?(environment = plain) ?(world = world) text =
  match Agreement.check environment (Pure_run.compile_exn (picks ^ text)) world with
  | Ok (Some found) -> found
  | Ok None -> Alcotest.fail "too large"
  | Error what -> Alcotest.fail what

let property = Alcotest.testable Dolphin_explore.Property.pp ( = )

let breaks name ?environment ?world expected text =
  let test () = Alcotest.(check (list property)) name expected (check ?environment ?world text).broken in
  Alcotest.test_case name `Quick test

(* What exploring stops at in one order of the steps, and not in the other. *)
let unclear name text =
  let test () =
    let program = Pure_run.compile_exn (picks ^ text) in
    match Agreement.check plain program Test_support.Generate.open_world with
    | Ok None -> ()
    | Ok (Some _) -> Alcotest.fail "it is clear"
    | Error what -> Alcotest.fail what
  in
  Alcotest.test_case name `Quick test

let saves name ?environment most text =
  let test () =
    let found = check ?environment text in
    if found.reduced > most then
      Alcotest.failf "%d of %d states are left, at most %d expected" found.reduced found.whole most
  in
  Alcotest.test_case name `Quick test

let traps =
  [
    unclear "a rest that may be another value"
      {|def tasks(rest, whole) { return action { if (poll(z: whole)) { halt 'h' } } | action { post z: rest } }
        p = imcPlan { locate 41, -8; goTo(); move 0, 100; goTo() }
        execute tasks(p.rest(a), p)|};
    breaks "a key that is passed on, whose task ends" [ No_deadlock ]
      {|execute fresh { k -> action { post door: k } >> task('p')[a] } |
        (waitFor { consume door: _ } then { k ->
          action { post((k): 1) } >> task('q')[b] >> condition { poll((k): 1) } })|};
    breaks "a key that is passed on, and given again" [ No_deadlock ]
      {|g = 0
        execute (repeat 2, task('p')[a] >> fresh { k ->
            action { if (g == 0) { post door: k }
              g = g + 1 } >> condition { g < 2 || !poll((k): 1) } }) |
          (waitFor { consume door: _ } then { k -> action { post((k): 1) } })|};
    breaks "a key in a variable" [ No_deadlock ]
      {|g = 0
        execute fresh { k -> action { g = k } >> task('p')[a] } |
          (condition { g != 0 } >> action { post((g): 1) } >> task('q')[b] >> condition { poll((g): 1) })|};
    breaks "until cuts a body before it posts" [ No_leftover ]
      {|execute (until { poll stop: 1 } run (task('p')[a] >> action { post x: 1 })) | action { post stop: 1 } |
        (task('q')[b] >> condition { consume stop: 1 } )|};
    breaks "the last part of several does what all of them ensure" [ No_leftover ]
      {|g = 0
        h = 0
        execute ((action { g = 1 } | task('q')[b]) ensure { h = 1 }) |
          (oneOf { when { g == 1 && h == 0 } then action { post x: 1 }; when { h == 1 } then action { g = 2 } })|};
    breaks "the last part of several, in a part that ends with it" [ No_leftover ]
      {|g = 0
        h = 0
        execute ((during 10 run (until { g == 5 } run (action { g = 1 } | task('q')[b]))) ensure { h = 1 }) |
          (oneOf { when { g == 1 && h == 0 } then action { post x: 1 }; when { h == 1 } then action { g = 2 } })|};
    breaks "until takes what another part waits for" [ No_deadlock ]
      {|execute (until { consume go: 1 } run task('p')[a]) | (task('q')[b] >> action { post go: 1 } >> condition { consume go: 1 })|};
    breaks "during lets its body go on or not" [ No_deadlock; No_leftover ]
      {|execute (during 1.minutes run (task('p')[a] >> action { post x: 1; post y: 1 })) | condition { consume x: 1 }|};
    breaks "handlers with one outcome, of which sensors choose" ~environment:failing
      ~world:Test_support.Generate.open_world [ No_error ]
      {|h = battery(a)
        execute (watch (watch (waitFor { h < 0.3 && battery(a) >= 0.3 || poll(x: 1) } then task('p')[a]
              | action { consume y: 1 }) onError {
            if (position(a) in area(location(41.1852, -8.7048), 400)) { ignore() } })
              | (during 2 run action { message 'm' })
          onError { ignore() }) | (watch task('p')[c] onError { 1 / 0 })|};
    breaks "an interruption between two steps that commute"
      ~environment:{ plain with faults = { Faults.none with interrupt = true } } [ Assertions; No_halt; No_leftover ]
      {|onInterrupt action {
            if (poll(x: 1) && !poll(y: 1)) { halt 'x alone' }
            assert { !poll(y: 1) || poll(x: 1) }, 'y alone'
        }
        execute action { post x: 1 } | action { post y: 1 }|};
    breaks "a branch that runs first, of a task that holds a vehicle" ~environment:failing [ No_error; No_halt ]
      {|post x: 1
        execute ({ task('p') >> allOf { when { true } then idle(1.seconds)
                                        when { consume x: 1 } then action { post go: 1 } } })[a]
            | watch (waitFor { consume go: 1 } then ({ task('q') })[a + b]) onError { e ->
                  if (e.vehicle == b) { halt 'a was held' }
                  ignore() }|};
    breaks "a branch that runs first, beside another part of a task that holds a vehicle" ~environment:failing
      [ No_error; No_halt ]
      {|post x: 1, y: 1
        execute ({ task('p') >> (condition { consume y: 1 } | allOf {
                when { true } then idle(1.seconds)
                when { consume x: 1 } then action { post go: 1 } }) })[a]
            | watch (waitFor { !poll(y: 1) && consume(go: 1) } then ({ task('q') })[a + b]) onError { e ->
                  if (e.vehicle == b) { halt 'a was held' }
                  ignore() }|};
    breaks "who is free when all that somebody recruited it for is over" [ No_halt; No_leftover ]
      {|release c
        post z: 1
        execute recruit { id 'c' } then { (action { post go: 1 } >> idle(1.seconds)) | idle(2.seconds) }
            | waitFor { consume go: 1 } then (until { poll z: 1 } run recruit { id 'c' } then { action { halt 'h' } })|};
    breaks "an input between two looks" ~environment:posting [ No_deadlock; No_halt ]
      {|input 'x'
        g = 0
        t = action { if (!poll(x: 1)) { g = 1 } } >> action { if (poll(x: 1) && g == 1) { halt 'h' } }
        execute t | task('p')[a]
        execute condition { consume x: 1 }|};
    breaks "an input for a guard that waits" ~environment:posting [ No_deadlock; No_halt ]
      {|input 'x'
        execute until { consume x: 1 } run (task('p')[a] >> action { halt 'h' })
        execute condition { false }|};
    breaks "an input that a branch waits for" ~environment:posting [ No_deadlock; No_leftover ]
      {|input 'x'
        post y: 1
        execute allOf { when { consume y: 1 } then task('p')[a]
                        when { consume x: 1 } then action { post z: 1 } }|};
    breaks "a poll for absence" [ No_halt ]
      {|execute (task('p')[a] >> action { if (!poll(x: 1)) { halt 'too early' } }) | (task('q')[b] >> action { post x: 1 })
        consume x: 1|};
    breaks "a pattern that tells pairs apart" [ No_halt ]
      {|execute (task('p')[a] >> action { if (count(x: { it > 1 }) == 1) { halt 'one' } }) | (task('q')[b] >> action { post x: 2 } >> action { post x: 3 })
        consume x: 2, x: 3|};
    breaks "a pattern takes the oldest" [ No_halt ]
      {|execute (task('p')[a] >> action { post x: 1 }) | (task('q')[b] >> action { post x: 2 })
        if (consume(x: { it > 0 }) && poll(x: 1)) { halt 'second' }
        consume x: _|};
    breaks "a guard with a pattern that a post does not meet" [ No_deadlock ]
      {|execute condition { consume x: { it > 1 } } | action { post x: 1 }|};
    breaks "a key that is computed" [ No_halt ]
      {|k = 'x' + 1
        execute (task('p')[a] >> action { if (!poll(x1: 1)) { halt 'too early' } })
            | (task('q')[b] >> action { post((k): 1) })
        consume x1: 1|};
    breaks "a key that is computed, of what others wait for" [ No_halt ]
      {|k = 'x' + 1
        execute (until { poll x1: 1 } run (task('p')[a] >> action { halt 'late' })) | action { post((k): 1) }
        consume x1: 1|};
    breaks "a key that is computed, which ends a task" [ No_deadlock ]
      {|k = 'x' + 1
        post x1: 1
        execute condition { consume x1: 1 } | action { consume((k): 1) }|};
    breaks "a negated guard" [ No_deadlock ]
      {|execute (task('p')[a] >> condition { !poll(x: 1) }) | action { post x: 1 }
        consume x: 1|};
    breaks "an action that takes if it can" [ No_leftover ]
      {|execute action { consume x: 1 } | action { post x: 1 }|};
    breaks "two consumers of one key" [ No_deadlock ]
      {|post x: 1
        execute (condition { consume x: 1 } >> action { post y: 1 } >> condition { consume y: 1 }) |
          (waitFor { consume x: 1 } then (action { post x: 1 } >> condition { consume x: 1 }))|};
    breaks "the oldest pair" [ No_halt ]
      {|execute action { post x: 1 } | action { post x: 2 } |
          (condition { poll(x: 1) && poll(x: 2) } >> action { consume x: _ ; if (poll(x: 1)) { halt '2 was first' } })
        consume x: _
        |};
    breaks "two writers of a global" [ No_leftover ]
      {|g = 0
        execute action { g = 1 } | action { g = 2 }
        if (g == 1) { post x: 1 }|};
    breaks "a reader of a global" [ No_error ]
      {|g = 1
        execute (task('p')[a] >> action { g = 0 }) | (task('q')[b] >> action { 1 / g })|};
    breaks "a fault that others prevent" [ No_error ]
      {|g = 0
        execute (task('p')[a] >> action { g = 1 }) | action { 1 / g } | task('q')[b]|};
    breaks "a fault that others cause, beside a way to go on" [ No_error; No_leftover ]
      {|g = 1
        execute (task('p')[a] >> action { g = 0 } >> action { post x: 1 }) |
          (task('q')[b] >> oneOf { when { 1 / g > 0 } then task('r')[b]
                                   when { false } then task('s')[b] })|};
    breaks "a handler that posts" ~environment:failing [ No_error; No_leftover ]
      {|execute (watch task('p')[a] onError { post x: 1 ; ignore() }) | task('q')[b]|};
    breaks "a handler that looks before it ignores" ~environment:failing [ No_error; No_halt ]
      {|execute (watch task('p')[a] onError { if (poll(x: 1)) { ignore() } else { halt 'h' } }) |
          (task('q')[b] >> action { post x: 1 })
        consume x: 1|};
    breaks "an error that stops what runs beside it" ~environment:failing [ No_leftover ]
      {|execute watch (task('p')[a] | (task('q')[b] >> action { post x: 1 })) onError { ignore() }|};
    breaks "an error kept from climbing by an outer watch" ~environment:failing [ No_leftover ]
      {|execute watch (watch (task('p')[a] | action { post x: 1 }) onError { propagate() }) onError { ignore() }
        |};
    breaks "one failure only" ~environment:(Environment.failing ~failures:1 plain) [ No_error ]
      {|execute (watch task('p')[a] onError { ignore() }) | task('q')[b]|};
    breaks "only one of two failures" ~environment:(Environment.failing ~failures:1 plain) [ No_deadlock ]
      {|execute (watch (task('p')[a] >> condition { false }) onError { ignore() }) |
          (watch (task('q')[b] >> condition { false }) onError { ignore() })|};
    breaks "branches of allOf that wait for each other" [ No_deadlock ]
      {|post x: 1, y: 1
        execute allOf { when { consume x: 1 } then action { post z: 1 }
                        when { consume y: 1 } then condition { consume z: 1 } }|};
    breaks "branches of allOf that take the same" [ No_deadlock ]
      {|post x: 1
        execute allOf { when { consume x: 1 } then task('p')[a]
                        when { consume x: 1 } then task('q')[a] }|};
    breaks "an allOf that is cut short" [ No_leftover ]
      {|post x: 1, y: 1
        execute (until { consume x: 1 } run allOf { when { consume y: 1 } then task('p')[a]
                                                    when { poll x: 1 } then task('q')[a] })|};
    breaks "a branch whose task never succeeds"
      ~environment:{ plain with endings = (fun _ name -> if name = "p" then Fails else Succeeds) }
      [ No_error; No_halt ]
      {|post x: 1, y: 1
        execute allOf { when { consume x: 1 } then task('p')[a]
                        when { consume y: 1 } then (task('q')[a] >> action { halt 'h' }) }|};
    breaks "an allOf beside another consumer, in one part" [ No_deadlock; No_halt ]
      {|post x: 1, y: 1
        execute (allOf { when { consume x: 1 } then task('p')[a]
                         when { consume y: 1 } then task('q')[a] } |
                 (condition { consume x: 1 } >> action { halt 'h' })) >> task('r')[b]|};
    breaks "a branch that is faulty, and would not be later" [ No_error; No_leftover ]
      {|g = 0
        execute oneOf { when { 1 / g > 0 } then action { post x: 1 }
                        when { true } then action { } } | action { g = 1 }|};
    breaks "a branch of allOf whose guard posts what another waits for" [ No_deadlock ]
      {|post x: 1, y: 1
        execute allOf { when { post z: 1 ; consume x: 1 } then task('p')[a]
                        when { consume y: 1 } then condition { consume z: 1 } }|};
    breaks "a guard that may hold now, and otherwise could later" ~world:Test_support.Generate.open_world
      [ No_halt; No_leftover ]
      {|post x: 1
        execute condition { consume x: (battery(a) < 0.3 ? 1 : 2) } | action { post x: 2 }
        if (poll(x: 1)) { halt 'it waited' }|};
    breaks "code that may end the run, or go on" ~world:Test_support.Generate.open_world [ No_halt; No_leftover ]
      {|execute action { if (battery(a) < 0.3) { halt 'low' } ; post x: 1 } | action { post x: 2 }|};
    breaks "a lost vehicle that is looked for again" ~environment:{ plain with faults = { Faults.none with loss = At_most 1 } }
      [ No_error; Vehicles ]
      {|execute (watch task('p')[a] onError { ignore() }) | task('q')[b]
        release a
        v = pick { id 'a' }|};
    breaks "who posts first" [ No_halt ]
      {|execute action { post x: 1 } | action { post x: 2 }
        consume x: _
        if (poll(x: 1)) { halt '2 was first' }
        consume x: _|};
    breaks "a consumer beside a test" [ No_leftover ]
      {|post x: 1
        execute condition { consume x: 1 } | action { if (poll(x: 1)) { post y: 1 } }|};
    breaks "a test beside a consumer" [ No_halt ]
      {|post x: 1
        execute action { if (!poll(x: 1)) { halt 'h' } } | condition { consume x: 1 }|};
    breaks "an assertion on how far others are" [ Assertions ]
      {|execute watch (task('p')[a] >> action { post x: 1 } >> task('q')[a] >> action { consume x: 1 }) |
                      (task('r')[b] >> assert({ !poll(x: 1) }, 'x is there')) onError { ignore() }|};
    breaks "until is faulty once all but one of its parts are done" [ No_error; No_leftover ]
      {|g = 1
        post x: 1
        execute until { 1 / g > 5 } run (task('p')[a] | action { g = 0 })|};
    breaks "until takes something once all but one of its parts are done" [ No_leftover ]
      {|post x: 1
        execute until { consume x: 1 } run (task('p')[a] | task('q')[b])|};
    breaks "assure fails once all but one of its parts are done" [ No_error ]
      {|g = 1
        execute assure { g == 1 } run (task('p')[a] | action { g = 0 })|};
    breaks "assure fails between two steps of another part" [ No_leftover ]
      {|execute watch (assure { !poll(x: 1) } run task('p')[a]) onError { post y: 1; ignore() }
          | (action { post x: 1 } >> condition { consume x: 1 })|};
    breaks "within fails while others run" [ No_leftover ]
      {|execute (watch (idle(5) within 3) onError { post y: 1; ignore() }) | task('p')[a]|};
    breaks "within cuts off what had not posted" [ No_deadlock ]
      {|execute (watch ((task('p')[a] >> action { post x: 1 }) within 3) onError { ignore() }) | condition { consume x: 1 }|};
    breaks "assure cuts off what had not posted" [ No_deadlock; No_leftover ]
      {|execute (watch (assure { !poll(stop: 1) } run (task('p')[a] >> action { post x: 1 })) onError { ignore() })
          | action { post stop: 1 } | condition { consume x: 1 }|};
    breaks "until cuts off what had posted" [ No_leftover ]
      {|execute until { poll stop: 1 } run (action { post x: 1 } | action { post y: 1 } | action { post stop: 1 })|};
    breaks "the end of one task frees the vehicle of another" [ No_leftover ]
      {|x = 0
        execute ({ task('p') >> action { x = 1 } })[a] | ({ task('q') >> action { if (x == 0) { post y: 1 } } })[a]|};
    breaks "which vehicle a task gets depends on who is held" [ No_error ]
      {|x = 0
        execute task('p')[a] | { task('q') >> action { x = 1 } } | { task('r') >> { idle(a).isEmpty() ? task('s') : task('t')[a - a] } }|};
    breaks "who is idle changes when a task ends" [ No_leftover ]
      {|execute task('p')[a] | action { if (idle(a).isEmpty()) { post y: 1 } }|};
    breaks "who runs changes when a task starts" [ No_leftover ]
      {|execute task('p')[a] | action { if (!running(a)) { post y: 1 } }|};
    breaks "who runs changes when a task ends, though it is held for the next one" [ No_deadlock; No_leftover ]
      {|execute (task('p')[a] >> task('q')[a]) | (condition { running(a) } >> action { if (!running(a)) { post y: 1 } })|};
    breaks "who runs changes between two tasks of one vehicle" [ No_deadlock; No_leftover ]
      {|execute (task('p')[a] >> task('q')[a]) |
          (condition { running(a) } >> condition { !running(a) } >> condition { running(a) } >> action { post y: 1 })|};
    breaks "who runs changes when a branch runs first" [ No_leftover ]
      {|execute allOf { when { true } then task('p')[a] } | action { if (running(a)) { post y: 1 } }|};
    breaks "an error stops who runs beside, before its handler asks" ~environment:failing [ No_error; No_halt ]
      {|execute (watch (task('p')[a] | task('q')[b]) onError { if (!running(a) && !running(b)) { halt 'both' } }) |
          task('r')[c]|};
    breaks "an error stops nobody outside of the handler's watch" ~environment:failing [ No_error; No_halt ]
      {|execute (watch task('p')[a] onError { if (running(b)) { halt 'runs' } }) | task('q')[b]|};
    breaks "what is not assured is stopped before a handler asks" [ No_halt ]
      {|execute watch (assure { !running(a) || !running(b) } run (task('p')[a] | task('q')[b]))
          onError { if (!running(a) && !running(b)) { halt 'stopped' }
                    ignore() }|};
    breaks "who is idle changes when a task is made" [ No_leftover ]
      {|execute ({ task('p') })[a] | action { if (idle(a).isEmpty()) { post y: 1 } }|};
    breaks "what is cut off holds nothing" [ No_deadlock ]
      {|execute (until { poll stop: 1 } run ({ task('p') >> condition { poll never: 1 } })[a]) | action { post stop: 1 } |
        ({ task('q') })[a] | condition { poll never: 1 }|};
    breaks "a task that is made bit by bit may post" [ No_error; No_leftover ]
      {|execute {
          def t = task('p')[a]
          t = oneOf { when { true } then t }
          t = t >> action { post x: 1 }
          t
        } | ((condition { poll x: 1 } >> action { post y: 1 }) within 5)|};
    breaks "what is tried again posts again" [ No_deadlock; No_halt ]
      {|execute (watch (action { post z: 1 } >> condition { consume go: 1 } >> action { 1 / 0 }) onError { retry() }) |
        (condition { consume z: 1 } >> action { if (poll(z: 1)) { halt 'again' } }) | action { post go: 1 }|};
    breaks "a task that is made may post" [ No_error; No_leftover ]
      {|execute { task('p')[a] >> action { post x: 1 } } | ((condition { poll x: 1 } >> action { post y: 1 }) within 5)|};
    breaks "a task that runs anew posts again" ~environment:failing [ No_leftover ]
      {|execute (watch (action { post x: 1 } >> task('p')[a]) onError { if (consume(x: 1)) retry() else ignore() }) |
          action { if (poll(x: 1)) { post y: 1 } }|};
    breaks "a task in the place of another posts" ~environment:failing [ No_error; No_leftover ]
      {|execute (watch task('p')[a] onError { action { post x: 1 } }) |
          ((condition { poll x: 1 } >> action { post y: 1 }) within 5)|};
    breaks "a task that runs anew has other vehicles" ~environment:failing [ No_leftover ]
      {|execute (watch { task('p') } onError { retry() }) | action { if (!idle(a).isEmpty()) { post y: 1 } }|};
    breaks "who is dismissed can be given nothing" ~environment:failing [ No_leftover ]
      {|execute (watch task('p')[a] onError { dismiss a; ignore() }) |
          (watch ({ task('q') })[a] onError { post y: 1; ignore() })|};
    breaks "whom a task beside still has is not dismissed" ~environment:failing [ No_error; No_halt ]
      {|execute (watch task('p')[a] onError { dismiss b; halt 'h' }) | (task('q')[b] >> idle(9))|};
    breaks "an error in a nest asks who is idle beside" ~environment:failing [ No_error; No_halt ]
      {|execute (watch (task('p')[a] | idle(9)) onError { if (idle(b).isEmpty()) { halt 'held' } else { ignore() } }) |
          task('q')[b]|};
    breaks "during ends between two posts" [ No_leftover ]
      {|execute during 1.minutes run (action { post x: 1 } | action { post y: 1 } | task('p')[a])|};
    breaks "what follows two parts, side by side with who looks" [ No_leftover ]
      {|post z: 1
        execute action { if (!poll(x: 1)) { post y: 1 } } |
          (watch ((condition { consume z: 1 } | action { post w: 1 }) >> action { post x: 1 }) onError { })|};
    breaks "an until around an allOf" [ No_leftover ]
      {|post x: 1, y: 1
        execute until { consume stop: 1 } run
          (allOf { when { consume x: 1 } then task('p')[a]
                   when { consume y: 1 } then task('q')[a] } | action { post stop: 1 })|};
    breaks "an allOf whose branch may fail, and be ignored" ~environment:failing [ No_leftover ]
      {|post x: 1, y: 1
        execute watch (allOf { when { consume x: 1 } then task('p')[a]
                               when { consume y: 1 } then task('q')[a] } | action { post z: 1 }) onError { ignore() }|};
    breaks "a duration that cannot be computed, which is ignored" [ No_deadlock; No_leftover ]
      {|execute (watch (during { true } run idle(1)) onError { post x: 1 ; ignore() }) |
          action { if (poll(x: 1)) { post y: 1 } }
        execute condition { consume y: 1 }|};
    breaks "a failure that is ignored, between two posts" ~environment:failing [ No_leftover ]
      {|execute watch (task('p')[a] | action { post x: 1 } | action { post y: 1 }) onError { ignore() }|};
    breaks "a failure that is ignored, between two that take" ~environment:failing [ No_leftover ]
      {|post x: 1, y: 1
        execute watch (task('p')[a] | action { consume x: 1 } | action { consume y: 1 }) onError { ignore() }|};
    breaks "a failure that is ignored, between two that write" ~environment:failing [ No_leftover ]
      {|g = 1
        h = 1
        execute watch (task('p')[a] | action { g = 2 } | action { h = 2 }) onError { ignore() }
        if (g > h) { post x: 1 }|};
    breaks "a failure in an inner until" ~environment:failing [ No_leftover ]
      {|execute watch ((until { poll stop: 1 } run (task('p')[a] | action { post x: 1 })) | action { post stop: 1 })
          onError { ignore() }|};
    breaks "a handler that posts what others look for" ~environment:failing [ No_leftover ]
      {|post z: 1
        execute action { if (!poll(x: 1)) { post y: 1 } } |
          (watch ((condition { consume z: 1 } >> task('p')[a]) | action { post w: 1 }) onError { post x: 1 ; ignore() })|};
    breaks "what follows an until that looks for what another part has" [ No_leftover ]
      {|post z: 1
        execute action { if (!poll(x: 1)) { post y: 1 } } |
          ((until { poll z: 1 } run (condition { consume u: 1 } | condition { consume v: 1 })) >> action { post x: 1 })|};
    breaks "what handles errors of what follows an until" ~environment:failing [ No_leftover ]
      {|post z: 1
        execute action { if (!poll(x: 1)) { post y: 1 } } |
          (watch ((until { poll z: 1 } run (condition { consume u: 1 } | condition { consume v: 1 })) >> task('p')[a])
             onError { post x: 1 ; ignore() })|};
    breaks "a lost vehicle that is missed later" ~environment:{ plain with faults = { Faults.none with loss = Any_number } }
      [ Vehicles ]
      {|execute watch (task('q')[b] | (watch task('p')[a] onError { ignore() })) onError { ignore() }
        release a
        release b
        x = pick { type 'UUV'; timeout 1.seconds }|};
    breaks "one failure only, ignored in one of two nests" ~environment:(Environment.failing ~failures:1 plain)
      [ No_deadlock ]
      {|execute (watch ((task('p')[a] >> condition { false }) | task('q')[b]) onError { ignore() }) |
          (watch ((task('r')[c] >> condition { false }) | condition { false }) onError { ignore() })|};
    breaks "code behind a variable" [ No_halt ]
      {|f = { post x: 1 }
        execute action { f.call() } | (task('p')[a] >> action { if (poll(x: 1)) { halt 'h' } }) | task('q')[b]
        consume x: 1|};
    breaks "code behind a variable, called by its name" [ No_halt ]
      {|f = { post x: 1 }
        execute action { f() } | (task('p')[a] >> action { if (poll(x: 1)) { halt 'h' } }) | task('q')[b]
        consume x: 1|};
    breaks "a guard that looks for what another part takes" [ No_deadlock ]
      {|post x: 1
        execute condition { poll x: 1 } | condition { consume x: 1 }|};
    breaks "a function that looks" [ No_halt ]
      {|def look() { if (poll(x: 1)) { halt 'h' } }
        execute (task('p')[a] >> action { look() }) | (task('q')[b] >> action { post x: 1 })
        consume x: 1|};
  ]

(* Copies that are not interchangeable, or not all the way. *)
(* Rounds: steps outside of a set whose steps close a round must not be postponed without end. *)
let rounds =
  let terminates ?(environment = plain) name expected text =
    let test () =
      let verdict reduction =
        let options = { Search.default with reduction; search_again = 0; environment } in
        let text = if environment == plain then text else picks ^ text in
        let found = Search.run options (Pure_run.compile_exn text) world in
        match List.assoc Dolphin_explore.Property.Termination found.verdicts with
        | Holds -> "holds"
        | Holds_if _ -> "holds if"
        | Violated _ -> "violated"
        | By_design { repeats; retries; _ } -> Printf.sprintf "by design: %d" (List.length (repeats @ retries))
        | Unreached _ | Inconclusive _ -> "inconclusive"
      in
      let each reduction = Alcotest.(check string) name expected (verdict reduction) in
      List.iter each [ Whole; Partial_order; Symmetry; All ]
    in
    Alcotest.test_case name `Quick test
  in
  let halts = breaks in
  [
    halts "beside endless rounds" [ No_halt ]
      "execute (repeat idle(1)) | (idle(2) >> action { halt 'x' })";
    halts "beside rounds that are in the set of another" [ No_halt ]
      "execute (repeat (idle(1) >> action { post x: 1; consume x: 1 })) | (idle(2) >> action { if (poll(x: 2)) { post y: 1 }; halt 'x' })";
    terminates "an error beside what waits, again and again" "violated"
      {|execute repeat watch (idle(1) >> idle(2) | action { 1 / 0 } | action { message 'x' }) onError { ignore() }|};
    terminates "a task that is tried again before a vehicle is done" ~environment:failing "violated"
      {|execute watch (task('p')[a] >> task('q')[a] | task('r')[b] | (action { 1 / 0 } | { task 's' })) onError { retry() }|};
    terminates "an endless repeat" "by design: 1" "execute repeat idle(1)";
    terminates "two of them" "by design: 2" "execute (repeat idle(1)) | (repeat idle(2))";
    terminates "a time ends all rounds" "holds" "execute (repeat idle(1)) during 5";
    terminates "a time for each round ends none" "by design: 1" "execute repeat (idle(1) during 5)";
    terminates "nor does it if the round fails then" "by design: 1" "execute repeat (idle(1) within 5)";
    terminates "a failure of all rounds does" "holds" "execute watch ((repeat idle(1)) within 5) onError { ignore() }";
    terminates "a condition that comes to hold beside it" "holds"
      "execute (repeat idle(1) until { poll stop: 1 }) | (idle(2) >> action { post stop: 1 })";
    terminates "a condition that never holds" "violated" "execute repeat idle(1) until { poll stop: 1 }";
    terminates "a condition around, that comes to hold" "holds"
      "execute (until { poll stop: 1 } run repeat idle(1)) | (idle(2) >> action { post stop: 1 })";
    terminates "a condition around, that holds now and then" "by design: 2"
      "execute (until { poll x: 1 } run repeat idle(1)) | (repeat (idle(2) >> action { post x: 1 } >> idle(3) >> condition { consume x: 1 }))";
    terminates "rounds inside of rounds, which end" "by design: 1" "execute repeat (repeat 2, (idle(1) | idle(2)))";
    terminates "rounds inside of rounds, which do not" "violated"
      "execute repeat (idle(1) >> (repeat idle(2) until { poll stop: 1 }))";
    terminates "rounds without any wait" "violated"
      "post a: 1\nexecute (repeat waitFor { consume a: 1 } then action { post a: 1 }) | (repeat idle(1))";
    terminates "a loop of the script around rounds that end" "violated"
      "while (true) { execute (repeat idle(1)) during 5 }";
    terminates "a retry of what breaks at once" "violated" "execute watch action { fail 'x' } onError { retry() }";
    terminates "a retry of what fails for ever" ~environment:failing "by design: 1"
      "execute watch task('p')[a] onError { retry() }";
    terminates "retries that are counted" ~environment:failing "holds"
      "post x: 1, x: 2\nexecute watch task('p')[a] onError { if (consume(x: _)) retry() else ignore() }";
    terminates "a retry of what cannot fail" "holds" "a = pick { id 'a' }\nexecute watch task('p')[a] onError { retry() }";
    terminates "a time around retries" ~environment:failing "holds"
      "execute (watch task('p')[a] onError { retry() }) during 5";
    terminates "a part that waits beside the rounds" "by design: 1"
      "execute (repeat idle(1)) | condition { poll never: 1 }";
  ]

let copies =
  [
    breaks "the script asks for one of the copies' pairs" [ No_halt ]
      {|execute (task('p')[a] >> oneOf { when { true } then action { post x: 1 }
                                          when { true } then action { } }) |
                (task('q')[b] >> oneOf { when { true } then action { post x: 2 }
                                          when { true } then action { } })
        if (poll(x: 2) && !poll(x: 1)) { consume x: 2 ; halt 'only 2' }
        if (poll(x: 1)) { consume x: 1 }
        if (poll(x: 2)) { consume x: 2 }|};
    breaks "one copy's pair is there from the start" [ No_leftover ]
      {|post x: 1
        execute (task('p')[a] >> action { post x: 1 }) | (task('q')[b] >> action { post x: 2 }) |
          (condition { consume x: 1 } >> condition { consume x: 2 })|};
    breaks "the oldest pair of two" [ No_halt; No_leftover ]
      {|execute action { post x: 1 } | action { post x: 2 }
        consume x: _
        if (poll(x: 1)) { halt '2 was first' }|};
    breaks "code asks for one copy's pair only" [ No_halt ]
      {|execute (task('p')[a] >> action { post x: 1 }) | (task('q')[b] >> action { post x: 2 }) |
          (task('r')[c] >> action { if (poll(x: 2) && !poll(x: 1)) { halt 'h' } })
        consume x: 1
        consume x: 2|};
    breaks "a computed pair" [ No_halt ]
      {|def look(i) { if (poll(x: i) && !poll(x: 1)) { halt 'h' } }
        execute (task('p')[a] >> action { post x: 1 }) | (task('q')[b] >> action { post x: 2 }) | action { look(2) }
        consume x: 1
        consume x: 2|};
    breaks "another computed pair" [ No_halt ]
      {|def look(i) { if (poll(x: i) && !poll(x: 2)) { halt 'h' } }
        execute (task('p')[a] >> action { post x: 1 }) | (task('q')[b] >> action { post x: 2 }) | action { look(1) }
        consume x: 1
        consume x: 2|};
    breaks "another handler that reads the error" ~environment:failing [ No_error; No_halt ]
      {|execute watch (task('p')[a] | task('q')[b]) onError { if (it == 'p failed on a: failure') { halt 'p' } }|};
    breaks "the other one of the vehicles fails"
      ~environment:{ plain with endings = (fun v _ -> if v = "a" then Fails else Succeeds) }
      [ No_error ]
      {|execute (task('p')[a] >> action { post x: 1 }) | (task('q')[b] >> action { post x: 2 } >> condition { consume x: 1 })|};
    breaks "isomorphic subtasks of which one fails"
      ~environment:{ plain with endings = (fun v _ -> if v = "b" then Fails else Succeeds) }
      [ No_leftover ]
      {|execute (watch (task('p')[a] >> action { post x: 1 }) onError { ignore() }) |
          (watch (task('q')[b] >> action { post x: 2 }) onError { ignore() })
        if (poll(x: 2)) { halt 'b did not fail' }|};
    breaks "a symmetry that N has at first, and not later" [ No_leftover ]
      {|execute oneOf { when { true } then action { }
                      when { true } then action { } >> action { post x: 1 } }
        execute (during 1 run action { post x: 1 }) | (during 1 run action { post x: 2 })
        if (poll(x: 2)) { consume x: 2
                          if (poll(x: 2)) { halt 'x: 2 was posted twice' } }|};
    breaks "tasks that are alike before, and all begun" []
      {|s = task('p')[a] >> action { message 's' }
        t = task('q')[b] >> action { message 't' }
        execute s | t
        execute s|};
    breaks "handlers that are alike before" ~environment:failing [ No_error ]
      {|s = watch task('p')[a] onError { message 's' }
        t = watch task('q')[b] onError { message 't' }
        execute until { true } run oneOf { when { consume x: 1 } then s
                                           when { consume x: 2 } then t }
        execute s|};
    breaks "handlers that are alike later" ~environment:failing [ No_error ]
      {|s = watch task('p')[a] onError { message 's' ; ignore() }
        t = watch task('q')[b] onError { message 't' ; ignore() }
        execute s
        execute until { true } run oneOf { when { consume x: 1 } then s
                                           when { consume x: 2 } then t }
        execute task('r')[c]|};
    breaks "handlers that are alike, and all run" ~environment:failing [ No_error ]
      {|s = watch task('p')[a] onError { message 's' }
        t = watch task('q')[b] onError { message 't' }
        execute s | t
        execute s|};
    breaks "tasks that are alike later, and only one of them begun" []
      {|s = task('p')[a]
        t = task('q')[b]
        execute s
        execute until { true } run oneOf { when { consume x: 1 } then s
                                           when { consume x: 2 } then t }|};
    breaks "tasks that are alike before, and only one of them begun" []
      {|s = task('p')[a]
        t = task('q')[b]
        execute until { true } run oneOf { when { consume x: 1 } then s
                                           when { consume x: 2 } then t }
        execute s|};
    breaks "a handler that reads the error" ~environment:failing [ No_error; No_halt ]
      {|execute watch (task('p')[a] | task('q')[b]) onError { if (it.contains('q')) { halt 'q' } }|};
    breaks "one of the vehicles fails"
      ~environment:{ plain with endings = (fun v _ -> if v = "b" then Fails else Succeeds) }
      [ No_leftover ]
      {|execute (watch task('p')[a] onError { ignore() }) | (watch task('q')[b] onError { post x: 1 ; ignore() })|};
    breaks "numbers that are counted with" [ No_halt ]
      {|g = 0
        execute (task('p')[a] >> action { g = g + 1 }) | (task('q')[b] >> action { g = g + 2 }) |
          action { if (g == 2) { halt 'h' } }|};
    breaks "the same code alike here, and not there" [ No_deadlock ]
      {|def both() { execute (task('p')[a] >> condition { consume x: 1 }) | (task('q')[b] >> condition { consume x: 2 }) }
        post x: 1, x: 2
        both()
        post x: 1
        both()|};
    breaks "a task of one copy never comes to its turn" [ No_leftover ]
      {|post x: 1
        execute oneOf { when { consume x: 1 } then task('p')[a]
                        when { consume x: 2 } then task('q')[b] }
        post x: 3|};
    breaks "who was left over matters later" [ No_deadlock; No_halt ]
      {|post x: 1, x: 2, x: 3
        execute oneOf { when { consume x: 1 } then task('p')[a]
                        when { consume x: 2 } then task('q')[a]
                        when { consume x: 3 } then task('r')[a] }
        if (!poll(x: 3)) { halt 'three' }
        execute condition { consume x: 1 }
        execute condition { consume x: 2 }
        consume x: 3|};
    breaks "around and around, with other ones each time" [ Termination ]
      {|post x: 1, x: 2
        while (true) {
          execute oneOf { when { consume x: 1 } then action { post y: 1 }
                          when { consume x: 2 } then action { post y: 2 } }
          execute oneOf { when { consume y: 1 } then action { post x: 1 }
                          when { consume y: 2 } then action { post x: 2 } }
        }|};
  ]

(* Both searches share these parts of the semantics: comparing them with each other would not show a mistake there. *)
let semantics =
  [
    breaks "a time below 0" [ No_error ] "execute during { -1 } run task('p')[a]";
    breaks "a vehicle that is bound" [ Vehicles ] "v = pick { id 'a' ; timeout 1.seconds }";
    breaks "an allocation around an allocation" ~environment:{ plain with endings = (fun v _ -> if v = "a" then Fails else Succeeds) }
      [] "execute (task('p')[a + b])[b]";
  ]

let fleet n =
  let each separator f = String.concat separator (List.init n (fun i -> f (i + 1))) in
  let vehicle i = List.nth [ "a"; "b" ] (i - 1) in
  Printf.sprintf "execute %s | allOf { %s }"
    (each " | " (fun i -> Printf.sprintf "(task('s%d')[%s] >> action { post ready: %d } >> task('k%d')[%s])" i (vehicle i) i i (vehicle i)))
    (each "\n" (fun i -> Printf.sprintf "when { consume ready: %d } then task('r%d')[c]" i i))

let savings =
  [
    saves "tasks that share nothing" 15 "execute task('p')[a] | task('q')[b] | task('r')[c]";
    saves "a rendezvous" 25 (fleet 2);
    saves "a rendezvous with failures" ~environment:failing 32 (fleet 2);
    saves "a rendezvous under watch" ~environment:failing 32
      (Printf.sprintf "t = %s\nexecute watch t onError { message 'failed' ; halt 'h' }"
         (String.sub (fleet 2) 8 (String.length (fleet 2) - 8)));
    saves "parts for a time" 17 "execute during 1.minutes run (task('p')[a] | task('q')[b] | task('r')[c])";
    saves "parts until something is there" 17
      "execute (until { poll stop: 1 } run (task('p')[a] | task('q')[b])) | (task('r')[c] >> action { post stop: 1 })\n\
       consume stop: 1";
    saves "parts whose failures are ignored" ~environment:failing 20
      "execute watch (task('p')[a] | task('q')[b] | task('r')[c]) onError { ignore() }";
    saves "nests side by side" ~environment:failing 20
      "execute (during 1.minutes run (task('p')[a] | task('q')[b])) | (watch (task('r')[c] | idle(1.seconds)) onError { \
       ignore() })";
    saves "copies that start with a choice" 40
      {|execute (task('p')[a] >> action { post x: 1 } >> condition { consume x: 1 }) |
          (task('q')[b] >> action { post x: 2 } >> condition { consume x: 2 }) |
          (task('r')[c] >> action { post x: 3 } >> condition { consume x: 3 })|};
    saves "copies that take from each other" 40
      {|post x: 1, x: 2, x: 3
        execute condition { consume x: _ } | condition { consume x: _ } | condition { consume x: _ }|};
    saves "parts of a sequence" 15 "execute (task('p')[a] | task('q')[b]) >> task('r')[c]";
  ]

(* Each of these begins an execution with several N, of which some break a symmetry of the task. The group of an
   execution must fix them all: otherwise a configuration is kept once for each group. *)
let one_group =
  let most name text =
    let test () =
      let states reduction =
        let program = Pure_run.compile_exn (picks ^ text) in
        (Dolphin_explore.Search.(run { default with reduction }) program world).states
      in
      Alcotest.(check bool) "no more than without symmetry" true (states Symmetry <= states Whole);
      Alcotest.(check bool) "no more than by partial order" true (states All <= states Partial_order)
    in
    Alcotest.test_case name `Quick test
  in
  [
    most "what is left in N breaks the symmetry at the next turn"
      {|g = 0
        while (g < 2) {
          g = g + 1
          execute (during 1 run action { post z: 3 }) | (during 1 run action { post z: 4 })
        }|};
    most "at three more turns"
      {|g = 0
        while (g < 4) {
          g = g + 1
          execute (during 1 run action { post z: 3 }) | (during 1 run action { post z: 4 })
        }|};
    most "at more turns than have a group of their own"
      {|g = 0
        while (g < 8) {
          g = g + 1
          execute (during 1 run action { post z: 3 }) | (during 1 run action { post z: 4 })
          if (g % 2 == 0) { consume z: 3 ; consume z: 4 }
        }|};
    most "an ordered key beside"
      {|g = 0
        while (g < 2) {
          g = g + 1
          post x: 3
          post x: 4
          execute ((watch action { post x: 3 } onError { ignore() }) | (during 1 run action { post z: 3 })) |
            ((watch action { post x: 4 } onError { ignore() }) | (during 1 run action { post z: 4 }))
          if (poll(y: 3)) { post x: 1 } else { consume x: _ }
        }|};
  ]

let () =
  Alcotest.run "reduction by hand"
    [ ("semantics", semantics); ("traps", traps); ("rounds", rounds); ("copies", copies); ("savings", savings); ("one group", one_group) ]
