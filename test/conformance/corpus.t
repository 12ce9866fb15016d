This implementation passes the corpus, and notices what is wrong in the cases that must fail.

  $ dolphin conform ../../conformance
  dolphin: ../../conformance/cases/input/order-is-kept.json: expect.trace: "N" is ["k",3], not a text
  [2]

So it does when it is asked as others are. A second runner, in Python, comes to the same verdicts, case by case.

  $ dolphin conform --impl 'dolphin step' --verbose ../../conformance > ours
  dolphin: ../../conformance/cases/input/order-is-kept.json: expect.trace: "N" is ["k",3], not a text
  [2]
  $ head -n 1 ours
  $ sed 1d ours > verdicts
  $ cases=$(find ../../conformance/cases ../../conformance/must-fail -name '*.json' | LC_ALL=C sort)
  $ python3 runner.py 'dolphin step' $cases > python
  [1]
  $ diff verdicts python
  0a1,415
  > passed ../../conformance/cases/alloc/a-solution-is-found.json
  > passed ../../conformance/cases/alloc/all-is-allocated-at-once.json
  > passed ../../conformance/cases/alloc/branches-beside-others.json
  > passed ../../conformance/cases/alloc/branches-share.json
  > passed ../../conformance/cases/alloc/by-names.json
  > passed ../../conformance/cases/alloc/by-no-name.json
  > passed ../../conformance/cases/alloc/chain-of-choices.json
  > passed ../../conformance/cases/alloc/distinct-at-once.json
  > passed ../../conformance/cases/alloc/fewest-before-nearest.json
  > passed ../../conformance/cases/alloc/fewest-vehicles.json
  > passed ../../conformance/cases/alloc/least-sum.json
  > passed ../../conformance/cases/alloc/left-to-right.json
  > passed ../../conformance/cases/alloc/nearest.json
  > passed ../../conformance/cases/alloc/no-task-no-vehicle.json
  > passed ../../conformance/cases/alloc/no-vehicle.json
  > passed ../../conformance/cases/alloc/payload-that-nobody-has.json
  > passed ../../conformance/cases/alloc/payload.json
  > passed ../../conformance/cases/alloc/pick-order.json
  > passed ../../conformance/cases/alloc/restricted-to-nothing.json
  > passed ../../conformance/cases/alloc/restricted-twice.json
  > passed ../../conformance/cases/alloc/restriction-of-a-composition.json
  > passed ../../conformance/cases/alloc/too-few.json
  > passed ../../conformance/cases/alloc/vehicles-of-the-plan.json
  > passed ../../conformance/cases/allof/a-guard-breaks.json
  > passed ../../conformance/cases/allof/any-ready-branch.json
  > passed ../../conformance/cases/allof/deeds-of-the-guard.json
  > passed ../../conformance/cases/allof/each-branch-once.json
  > passed ../../conformance/cases/allof/error-of-a-branch.json
  > passed ../../conformance/cases/allof/guards-rest-while-a-branch-runs.json
  > passed ../../conformance/cases/allof/in-the-order-of-the-text.json
  > passed ../../conformance/cases/allof/one-at-a-time.json
  > passed ../../conformance/cases/allof/stuck.json
  > passed ../../conformance/cases/allof/timers-start-with-the-branch.json
  > passed ../../conformance/cases/allof/two-allofs-compete.json
  > passed ../../conformance/cases/allof/waits-for-a-sibling.json
  > passed ../../conformance/cases/assert/holds.json
  > passed ../../conformance/cases/assert/in-a-duration.json
  > passed ../../conformance/cases/assert/in-a-guard.json
  > passed ../../conformance/cases/assert/in-a-handler.json
  > passed ../../conformance/cases/assert/in-an-until.json
  > passed ../../conformance/cases/assert/in-the-script.json
  > passed ../../conformance/cases/assert/leaves-no-effect.json
  > passed ../../conformance/cases/assert/no-watch-handles-it.json
  > passed ../../conformance/cases/assert/text-is-not-computed-before.json
  > passed ../../conformance/cases/assert/text.json
  > passed ../../conformance/cases/code/action-is-one-step.json
  > passed ../../conformance/cases/code/action-without-deeds.json
  > passed ../../conformance/cases/code/assignments-are-in-the-store.json
  > passed ../../conformance/cases/code/condition-breaks.json
  > passed ../../conformance/cases/code/condition-waits.json
  > passed ../../conformance/cases/code/condition-with-deeds.json
  > passed ../../conformance/cases/code/connection-timeout-in-an-action.json
  > passed ../../conformance/cases/code/endless-action.json
  > passed ../../conformance/cases/code/false-guard-assigns-nothing.json
  > passed ../../conformance/cases/code/false-guard-consumes-nothing.json
  > passed ../../conformance/cases/code/false-guard-posts-nothing.json
  > passed ../../conformance/cases/code/fault-leaves-no-effect.json
  > passed ../../conformance/cases/code/halt-cancels-timers.json
  > passed ../../conformance/cases/code/halt-in-an-action.json
  > passed ../../conformance/cases/code/said-before-a-fault.json
  > passed ../../conformance/cases/code/true-guard-assigns.json
  > passed ../../conformance/cases/code/truth-of-empty-list.json
  > passed ../../conformance/cases/code/truth-of-empty-map.json
  > passed ../../conformance/cases/code/truth-of-empty-text.json
  > passed ../../conformance/cases/code/truth-of-list-of-zero.json
  > passed ../../conformance/cases/code/truth-of-negative.json
  > passed ../../conformance/cases/code/truth-of-null.json
  > passed ../../conformance/cases/code/truth-of-text.json
  > passed ../../conformance/cases/code/truth-of-zero.json
  > passed ../../conformance/cases/code/watched-fault.json
  > passed ../../conformance/cases/code/wrong-types-are-a-fault.json
  > passed ../../conformance/cases/end/completed.json
  > passed ../../conformance/cases/end/fault.json
  > passed ../../conformance/cases/end/halt-in-a-function.json
  > passed ../../conformance/cases/end/halt-without-a-text.json
  > passed ../../conformance/cases/end/halt.json
  > passed ../../conformance/cases/end/no-value-yet.json
  > passed ../../conformance/cases/end/too-deep.json
  > passed ../../conformance/cases/input/not-declared.json
  > failed ../../conformance/cases/input/order-is-kept.json: trace
  > failed ../../conformance/cases/input/while-a-task-waits.json: trace
  > failed ../../conformance/cases/input/while-the-script-waits.json: trace
  > passed ../../conformance/cases/interrupt/ask.json
  > passed ../../conformance/cases/interrupt/call.json
  > passed ../../conformance/cases/interrupt/no-watch-handles-it.json
  > passed ../../conformance/cases/interrupt/once.json
  > passed ../../conformance/cases/interrupt/pause.json
  > passed ../../conformance/cases/interrupt/pick.json
  > passed ../../conformance/cases/interrupt/script.json
  > passed ../../conformance/cases/interrupt/tasks.json
  > passed ../../conformance/cases/language/branches-in-a-loop.json
  > passed ../../conformance/cases/language/globals-by-reference.json
  > passed ../../conformance/cases/language/handlers-and-laws.json
  > passed ../../conformance/cases/language/left-to-right.json
  > passed ../../conformance/cases/language/locals-by-value.json
  > passed ../../conformance/cases/language/loops.json
  > passed ../../conformance/cases/language/maximum-minimum.json
  > passed ../../conformance/cases/language/parameters-by-value.json
  > passed ../../conformance/cases/language/ranges.json
  > passed ../../conformance/cases/language/recursion.json
  > passed ../../conformance/cases/language/rendezvous.json
  > passed ../../conformance/cases/language/short-cut.json
  > passed ../../conformance/cases/language/tasks-by-recursion.json
  > passed ../../conformance/cases/language/values-are-immutable.json
  > passed ../../conformance/cases/nested/allof-in-allof.json
  > passed ../../conformance/cases/nested/allof-in-during.json
  > passed ../../conformance/cases/nested/allof-in-oneof.json
  > passed ../../conformance/cases/nested/allof-in-par.json
  > passed ../../conformance/cases/nested/allof-in-seq.json
  > passed ../../conformance/cases/nested/allof-in-until.json
  > passed ../../conformance/cases/nested/allof-in-watch.json
  > passed ../../conformance/cases/nested/cut-in-allof.json
  > passed ../../conformance/cases/nested/cut-in-during.json
  > passed ../../conformance/cases/nested/cut-in-oneof.json
  > passed ../../conformance/cases/nested/cut-in-par.json
  > passed ../../conformance/cases/nested/cut-in-seq.json
  > passed ../../conformance/cases/nested/cut-in-until.json
  > passed ../../conformance/cases/nested/cut-in-watch.json
  > passed ../../conformance/cases/nested/during-in-allof.json
  > passed ../../conformance/cases/nested/during-in-during.json
  > passed ../../conformance/cases/nested/during-in-oneof.json
  > passed ../../conformance/cases/nested/during-in-par.json
  > passed ../../conformance/cases/nested/during-in-seq.json
  > passed ../../conformance/cases/nested/during-in-until.json
  > passed ../../conformance/cases/nested/during-in-watch.json
  > passed ../../conformance/cases/nested/ignored-in-allof.json
  > passed ../../conformance/cases/nested/ignored-in-during.json
  > passed ../../conformance/cases/nested/ignored-in-oneof.json
  > passed ../../conformance/cases/nested/ignored-in-par.json
  > passed ../../conformance/cases/nested/ignored-in-seq.json
  > passed ../../conformance/cases/nested/ignored-in-until.json
  > passed ../../conformance/cases/nested/ignored-in-watch.json
  > passed ../../conformance/cases/nested/oneof-in-allof.json
  > passed ../../conformance/cases/nested/oneof-in-during.json
  > passed ../../conformance/cases/nested/oneof-in-oneof.json
  > passed ../../conformance/cases/nested/oneof-in-par.json
  > passed ../../conformance/cases/nested/oneof-in-seq.json
  > passed ../../conformance/cases/nested/oneof-in-until.json
  > passed ../../conformance/cases/nested/oneof-in-watch.json
  > passed ../../conformance/cases/nested/par-in-allof.json
  > passed ../../conformance/cases/nested/par-in-during.json
  > passed ../../conformance/cases/nested/par-in-oneof.json
  > passed ../../conformance/cases/nested/par-in-par.json
  > passed ../../conformance/cases/nested/par-in-seq.json
  > passed ../../conformance/cases/nested/par-in-until.json
  > passed ../../conformance/cases/nested/par-in-watch.json
  > passed ../../conformance/cases/nested/seq-in-allof.json
  > passed ../../conformance/cases/nested/seq-in-during.json
  > passed ../../conformance/cases/nested/seq-in-oneof.json
  > passed ../../conformance/cases/nested/seq-in-par.json
  > passed ../../conformance/cases/nested/seq-in-seq.json
  > passed ../../conformance/cases/nested/seq-in-until.json
  > passed ../../conformance/cases/nested/seq-in-watch.json
  > passed ../../conformance/cases/nested/until-in-allof.json
  > passed ../../conformance/cases/nested/until-in-during.json
  > passed ../../conformance/cases/nested/until-in-oneof.json
  > passed ../../conformance/cases/nested/until-in-par.json
  > passed ../../conformance/cases/nested/until-in-seq.json
  > passed ../../conformance/cases/nested/until-in-until.json
  > passed ../../conformance/cases/nested/until-in-watch.json
  > passed ../../conformance/cases/nested/watch-in-allof.json
  > passed ../../conformance/cases/nested/watch-in-during.json
  > passed ../../conformance/cases/nested/watch-in-oneof.json
  > passed ../../conformance/cases/nested/watch-in-par.json
  > passed ../../conformance/cases/nested/watch-in-seq.json
  > passed ../../conformance/cases/nested/watch-in-until.json
  > passed ../../conformance/cases/nested/watch-in-watch.json
  > passed ../../conformance/cases/oneof/a-guard-breaks.json
  > passed ../../conformance/cases/oneof/any-ready-branch.json
  > passed ../../conformance/cases/oneof/branch-starts-vehicles.json
  > passed ../../conformance/cases/oneof/choose.json
  > passed ../../conformance/cases/oneof/competing-for-a-tuple.json
  > passed ../../conformance/cases/oneof/deeds-of-the-guard.json
  > passed ../../conformance/cases/oneof/error-of-the-branch.json
  > passed ../../conformance/cases/oneof/in-a-sequence.json
  > passed ../../conformance/cases/oneof/nothing-ready.json
  > passed ../../conformance/cases/oneof/posted-twice-is-two.json
  > passed ../../conformance/cases/oneof/vehicle-sensors.json
  > passed ../../conformance/cases/oneof/wait-for.json
  > passed ../../conformance/cases/par/deadlock.json
  > passed ../../conformance/cases/par/either-starts-first.json
  > passed ../../conformance/cases/par/error-forgets-what-has-not-started.json
  > passed ../../conformance/cases/par/error-stops-left-and-right.json
  > passed ../../conformance/cases/par/error-stops-the-sibling.json
  > passed ../../conformance/cases/par/flat.json
  > passed ../../conformance/cases/par/handshake.json
  > passed ../../conformance/cases/par/leftmost-first.json
  > passed ../../conformance/cases/par/many-actions.json
  > passed ../../conformance/cases/par/order-is-observable.json
  > passed ../../conformance/cases/par/stopped-tasks-do-not-fail-again.json
  > passed ../../conformance/cases/par/two-timers.json
  > passed ../../conformance/cases/par/unhandled-error.json
  > passed ../../conformance/cases/par/waits-for-all.json
  > passed ../../conformance/cases/pick/all-of-none.json
  > passed ../../conformance/cases/pick/all-that-are-there.json
  > passed ../../conformance/cases/pick/any-choice.json
  > passed ../../conformance/cases/pick/by-payload.json
  > passed ../../conformance/cases/pick/by-region.json
  > passed ../../conformance/cases/pick/by-type.json
  > passed ../../conformance/cases/pick/escaped-id.json
  > passed ../../conformance/cases/pick/in-a-loop.json
  > passed ../../conformance/cases/pick/joins-later.json
  > passed ../../conformance/cases/pick/met-in-the-last-moment.json
  > passed ../../conformance/cases/pick/not-connected.json
  > passed ../../conformance/cases/pick/not-ready.json
  > passed ../../conformance/cases/pick/not-twice.json
  > passed ../../conformance/cases/pick/one.json
  > passed ../../conformance/cases/pick/too-few.json
  > passed ../../conformance/cases/rejected/all-faults-are-told.json
  > passed ../../conformance/cases/rejected/ask-by-a-function.json
  > passed ../../conformance/cases/rejected/assigned-function.json
  > passed ../../conformance/cases/rejected/assigned-setting.json
  > passed ../../conformance/cases/rejected/break-outside-of-a-loop.json
  > passed ../../conformance/cases/rejected/captured-local.json
  > passed ../../conformance/cases/rejected/captured-loop-variable.json
  > passed ../../conformance/cases/rejected/defined-twice.json
  > passed ../../conformance/cases/rejected/execute-in-a-handler.json
  > passed ../../conformance/cases/rejected/fleet.json
  > passed ../../conformance/cases/rejected/function-in-a-block.json
  > passed ../../conformance/cases/rejected/guard-with-a-parameter.json
  > passed ../../conformance/cases/rejected/ignore-outside-of-a-handler.json
  > passed ../../conformance/cases/rejected/input-inside.json
  > passed ../../conformance/cases/rejected/one-name-twice.json
  > passed ../../conformance/cases/rejected/one-vehicle-twice-at-once.json
  > passed ../../conformance/cases/rejected/pause-in-an-action.json
  > passed ../../conformance/cases/rejected/pick-in-a-guard.json
  > passed ../../conformance/cases/rejected/post-without-a-key.json
  > passed ../../conformance/cases/rejected/posting-the-wildcard.json
  > passed ../../conformance/cases/rejected/procedure-as-a-value.json
  > passed ../../conformance/cases/rejected/propagate-in-an-action.json
  > passed ../../conformance/cases/rejected/release-in-an-action.json
  > passed ../../conformance/cases/rejected/reserved-name.json
  > passed ../../conformance/cases/rejected/sequence-of-a-number.json
  > passed ../../conformance/cases/rejected/setting-outside.json
  > passed ../../conformance/cases/rejected/supplier-in-guard.json
  > passed ../../conformance/cases/rejected/syntax.json
  > passed ../../conformance/cases/rejected/unknown-argument.json
  > passed ../../conformance/cases/rejected/unknown-constant.json
  > passed ../../conformance/cases/rejected/unknown-function.json
  > passed ../../conformance/cases/rejected/unknown-name.json
  > passed ../../conformance/cases/rejected/unknown-setting.json
  > passed ../../conformance/cases/rejected/unknown-unit.json
  > passed ../../conformance/cases/rejected/warnings-are-none.json
  > passed ../../conformance/cases/rejected/when-outside.json
  > passed ../../conformance/cases/rejected/wildcard-as-a-value.json
  > passed ../../conformance/cases/rejected/wrong-arity.json
  > passed ../../conformance/cases/rejected/wrong-kind.json
  > passed ../../conformance/cases/rejected/wrong-value.json
  > passed ../../conformance/cases/release/cannot-be-used.json
  > passed ../../conformance/cases/release/nothing.json
  > passed ../../conformance/cases/release/only-what-is-bound.json
  > passed ../../conformance/cases/release/picked-again.json
  > passed ../../conformance/cases/release/some.json
  > passed ../../conformance/cases/script/consume-all-or-none.json
  > passed ../../conformance/cases/script/consume-from-the-middle.json
  > passed ../../conformance/cases/script/consume-nothing.json
  > passed ../../conformance/cases/script/consume-oldest-of-none.json
  > passed ../../conformance/cases/script/consume-oldest.json
  > passed ../../conformance/cases/script/consume-twice-the-same.json
  > passed ../../conformance/cases/script/consume.json
  > passed ../../conformance/cases/script/long-loop.json
  > passed ../../conformance/cases/script/message.json
  > passed ../../conformance/cases/script/poll.json
  > passed ../../conformance/cases/script/post.json
  > passed ../../conformance/cases/script/queues-tell-states-apart.json
  > passed ../../conformance/cases/script/set-timeout-of-all.json
  > passed ../../conformance/cases/script/set-timeout.json
  > passed ../../conformance/cases/script/short-computing-is-silent.json
  > passed ../../conformance/cases/script/silent-loop.json
  > passed ../../conformance/cases/script/timeout-longest.json
  > passed ../../conformance/cases/script/timeout-too-long.json
  > passed ../../conformance/cases/script/timeout-too-short.json
  > passed ../../conformance/cases/script/whole-numbers-are-one.json
  > passed ../../conformance/cases/seq/error-skips-the-rest.json
  > passed ../../conformance/cases/seq/goes-on.json
  > passed ../../conformance/cases/seq/in-parallel.json
  > passed ../../conformance/cases/seq/parallel-first.json
  > passed ../../conformance/cases/seq/parallel-second.json
  > passed ../../conformance/cases/seq/sees-what-went-before.json
  > passed ../../conformance/cases/seq/three-parts.json
  > passed ../../conformance/cases/seq/timers-by-place.json
  > passed ../../conformance/cases/seq/unhandled-error.json
  > passed ../../conformance/cases/sets/operators.json
  > passed ../../conformance/cases/sets/order-of-picks.json
  > passed ../../conformance/cases/sets/predicate.json
  > passed ../../conformance/cases/sets/tuples.json
  > passed ../../conformance/cases/task/a-term-starts-nothing.json
  > passed ../../conformance/cases/task/ends-once.json
  > passed ../../conformance/cases/task/executed-twice.json
  > passed ../../conformance/cases/task/failure-ends-the-program.json
  > passed ../../conformance/cases/task/inline-plan.json
  > passed ../../conformance/cases/task/may-end-either-way.json
  > passed ../../conformance/cases/task/no-end-before-the-start.json
  > passed ../../conformance/cases/task/nothing-after-the-end.json
  > passed ../../conformance/cases/task/one-term-twice-at-once.json
  > passed ../../conformance/cases/task/one-term-twice-in-a-row.json
  > passed ../../conformance/cases/task/other-vehicles-are-not-awaited.json
  > passed ../../conformance/cases/task/start-and-done.json
  > passed ../../conformance/cases/time/done-or-up.json
  > passed ../../conformance/cases/time/during-around-until.json
  > passed ../../conformance/cases/time/during-around-watch-around-par.json
  > passed ../../conformance/cases/time/during-asks-once.json
  > passed ../../conformance/cases/time/during-asks-when-its-turn-comes.json
  > passed ../../conformance/cases/time/during-code-breaks.json
  > passed ../../conformance/cases/time/during-cuts-before-the-start.json
  > passed ../../conformance/cases/time/during-cuts.json
  > passed ../../conformance/cases/time/during-done-in-time.json
  > passed ../../conformance/cases/time/during-error-in-time.json
  > passed ../../conformance/cases/time/during-negative.json
  > passed ../../conformance/cases/time/during-no-number.json
  > passed ../../conformance/cases/time/during-set-starts-the-body.json
  > passed ../../conformance/cases/time/during-set.json
  > passed ../../conformance/cases/time/during-zero-by-code.json
  > passed ../../conformance/cases/time/error-inside-of-parallel.json
  > passed ../../conformance/cases/time/idle-zero.json
  > passed ../../conformance/cases/time/idle.json
  > passed ../../conformance/cases/time/negative-idle.json
  > passed ../../conformance/cases/time/nested-inner-first.json
  > passed ../../conformance/cases/time/nested-outer-first.json
  > passed ../../conformance/cases/time/timers-of-all-kinds-cut.json
  > passed ../../conformance/cases/time/timers-wait-for-guards.json
  > passed ../../conformance/cases/time/units.json
  > passed ../../conformance/cases/time/until-around-during.json
  > passed ../../conformance/cases/time/within-by-code.json
  > passed ../../conformance/cases/time/within-done.json
  > passed ../../conformance/cases/time/within-fails.json
  > passed ../../conformance/cases/time/within-no-time.json
  > passed ../../conformance/cases/until/around-allof.json
  > passed ../../conformance/cases/until/assure-before-the-start.json
  > passed ../../conformance/cases/until/assure-breaks.json
  > passed ../../conformance/cases/until/assure-fails.json
  > passed ../../conformance/cases/until/assure-returns.json
  > passed ../../conformance/cases/until/assure-undoes.json
  > passed ../../conformance/cases/until/comes-before-the-task.json
  > passed ../../conformance/cases/until/competes-with-a-condition.json
  > passed ../../conformance/cases/until/condition-breaks.json
  > passed ../../conformance/cases/until/condition-halts.json
  > passed ../../conformance/cases/until/cuts-before-the-start.json
  > passed ../../conformance/cases/until/cuts-what-runs.json
  > passed ../../conformance/cases/until/done-by-itself.json
  > passed ../../conformance/cases/until/error-of-the-task.json
  > passed ../../conformance/cases/until/error-while-the-condition-holds.json
  > passed ../../conformance/cases/until/false-condition-does-nothing.json
  > passed ../../conformance/cases/until/message-of-the-condition.json
  > passed ../../conformance/cases/until/nested.json
  > passed ../../conformance/cases/until/of-a-battery.json
  > passed ../../conformance/cases/until/outer-cuts-the-inner.json
  > passed ../../conformance/cases/until/slash.json
  > passed ../../conformance/cases/until/the-sequence-goes-on.json
  > passed ../../conformance/cases/wait/answer-does-nothing.json
  > passed ../../conformance/cases/wait/answer-in-words.json
  > passed ../../conformance/cases/wait/answer-is-a-text.json
  > passed ../../conformance/cases/wait/answer-with-variables.json
  > passed ../../conformance/cases/wait/answers-lead-to-outcomes.json
  > passed ../../conformance/cases/wait/ask.json
  > passed ../../conformance/cases/wait/asked-twice.json
  > passed ../../conformance/cases/wait/bad-answer.json
  > passed ../../conformance/cases/wait/call-fails.json
  > passed ../../conformance/cases/wait/call-of-a-method.json
  > passed ../../conformance/cases/wait/call.json
  > passed ../../conformance/cases/wait/negative-pause.json
  > passed ../../conformance/cases/wait/no-answer.json
  > passed ../../conformance/cases/wait/pause-zero.json
  > passed ../../conformance/cases/wait/pause.json
  > passed ../../conformance/cases/watch/climbs-to-the-next.json
  > passed ../../conformance/cases/watch/done.json
  > passed ../../conformance/cases/watch/empty-handler.json
  > passed ../../conformance/cases/watch/error-is-a-text.json
  > passed ../../conformance/cases/watch/handler-breaks.json
  > passed ../../conformance/cases/watch/handler-consumes.json
  > passed ../../conformance/cases/watch/handler-halts-inside-of-watch.json
  > passed ../../conformance/cases/watch/handler-halts.json
  > passed ../../conformance/cases/watch/handler-sees-the-store.json
  > passed ../../conformance/cases/watch/handler-wakes-a-sibling.json
  > passed ../../conformance/cases/watch/ignore.json
  > passed ../../conformance/cases/watch/in-a-branch.json
  > passed ../../conformance/cases/watch/inner-ignores.json
  > passed ../../conformance/cases/watch/last-verdict-ignore.json
  > passed ../../conformance/cases/watch/last-verdict-propagate.json
  > passed ../../conformance/cases/watch/of-a-guard.json
  > passed ../../conformance/cases/watch/only-what-is-inside.json
  > passed ../../conformance/cases/watch/propagate.json
  > passed ../../conformance/cases/watch/propagates-by-default.json
  > passed ../../conformance/cases/watch/siblings-outside-go-on.json
  > passed ../../conformance/cases/watch/the-sequence-goes-on.json
  > passed ../../conformance/cases/watch/tried-again.json
  > passed ../../conformance/must-fail/accepted.json: rejected
  > passed ../../conformance/must-fail/deadlock.json: deadlock
  > passed ../../conformance/must-fail/event-not-awaited.json: trace
  > passed ../../conformance/must-fail/forbidden-in-vain.json: forbids
  > passed ../../conformance/must-fail/goes-too-far.json: trace
  > passed ../../conformance/must-fail/impossible-trace.json: admits
  > passed ../../conformance/must-fail/missing-effect.json: trace
  > passed ../../conformance/must-fail/missing-outcome.json: outcomes
  > passed ../../conformance/must-fail/no-deadlock.json: deadlock
  > passed ../../conformance/must-fail/not-covered.json: covers
  > passed ../../conformance/must-fail/one-of-two-traces.json: admits
  > passed ../../conformance/must-fail/order-of-effects.json: trace
  > passed ../../conformance/must-fail/possible-trace.json: forbids
  > passed ../../conformance/must-fail/rejected.json: trace
  > passed ../../conformance/must-fail/stops-short.json: trace
  > passed ../../conformance/must-fail/unexpected-outcome.json: outcomes
  > passed ../../conformance/must-fail/wrong-allocation.json: trace
  > passed ../../conformance/must-fail/wrong-bound-set.json: trace
  > passed ../../conformance/must-fail/wrong-code.json: rejected
  > passed ../../conformance/must-fail/wrong-effects.json: trace
  > passed ../../conformance/must-fail/wrong-label.json: trace
  > passed ../../conformance/must-fail/wrong-leftovers.json: outcomes
  > passed ../../conformance/must-fail/wrong-line.json: rejected
  > passed ../../conformance/must-fail/wrong-message.json: trace
  > passed ../../conformance/must-fail/wrong-order.json: trace
  > passed ../../conformance/must-fail/wrong-rule.json: trace
  > passed ../../conformance/must-fail/wrong-store.json: trace
  > passed ../../conformance/must-fail/wrong-tuples.json: trace
  > 411 passed, 3 failed
  [1]
  $ tail -n 1 python
  411 passed, 3 failed

Each rule of the semantics has a case that is about it, and takes it.

  $ dolphin conform --matrix ../../conformance > matrix
  dolphin: ../../conformance/cases/input/order-is-kept.json: expect.trace: "N" is ["k",3], not a text
  [2]
  $ sed '$d' matrix | awk '{ print $1 }' | LC_ALL=C sort > in_matrix
  $ sed -n 's/^ *---* *\[\([A-Z0-9-]*\)\]$/\1/p' ../../docs/semantics.md | LC_ALL=C sort > in_semantics
  $ diff in_matrix in_semantics
  0a1,63
  > ACTION
  > ACTION-ERR
  > ALLOC-ERR
  > ALLOF-1
  > ALLOF-2
  > ALLOF-ERR
  > ALLOF-WHEN
  > ANSWER
  > ANSWER-ERR
  > ASK
  > ASSERT-ERR
  > ASSURE-CUT
  > CALL
  > CALL-ERR
  > CONDITION
  > CONDITION-ERR
  > CONSUME
  > DONE
  > DURING-1
  > DURING-2
  > DURING-CUT
  > DURING-ERR
  > DURING-SET
  > END
  > EXECUTE
  > EXECUTE-DONE
  > EXECUTE-ERR
  > FAIL
  > FAULT
  > HALT
  > IDLE-END
  > INPUT
  > INTERRUPT
  > MESSAGE
  > ONEOF-ERR
  > ONEOF-WHEN
  > PAR-1
  > PAR-2
  > PAR-ERR
  > PAUSE
  > PICK
  > PICK-BIND
  > PICK-ERR
  > POST
  > RELEASE
  > REPLY
  > RESUME
  > SCRIPT
  > SEQ-1
  > SEQ-2
  > SEQ-ERR
  > SET-TIMEOUT
  > START
  > UNTIL-1
  > UNTIL-2
  > UNTIL-CUT
  > UNTIL-ERR
  > WATCH-1
  > WATCH-2
  > WATCH-HALT
  > WATCH-IGNORE
  > WATCH-PROPAGATE
  > WITHIN-CUT
  [1]
  $ grep ' none$' matrix
  [1]
  $ grep '^SEQ-ERR' matrix | grep -o 'seq/error-skips-the-rest'
  [1]

A rule that no case is about is told, and is a failure.

  $ dolphin conform --matrix ../../conformance/cases/seq | tail -n 2 | sed 's/, ACTION-ERR.*, INTERRUPT/, ..., INTERRUPT/'
  no case is about FAIL, ACTION, ..., INTERRUPT
  9 passed, 0 failed
  $ dolphin conform --matrix ../../conformance/cases/seq > /dev/null
  [1]

Cases, requests and replies are as the schemas say.

  $ python3 schema.py ../../conformance/schema/case.schema.json $cases
  ../../conformance/cases/input/order-is-kept.json: $.expect.trace[7]: {"label": "end", "N": [["k", 3]]} is not of type ['string']
  ../../conformance/cases/input/while-a-task-waits.json: $.expect.trace[1]: {"event": {"event": "input", "key": "go", "value": 2}, "labe is not of type ['string']
  ../../conformance/cases/input/while-the-script-waits.json: $.expect.trace[0]: {"event": {"event": "input", "key": "k", "value": "x"}, "lab is not of type ['string']
  414 checked, 3 wrong
  [1]
  $ cat > talk << 'END'
  > #!/bin/sh
  > tee requests | dolphin step | tee replies
  > END
  $ chmod +x talk
  $ dolphin conform --impl ./talk ../../conformance/cases/script ../../conformance/cases/wait ../../conformance/cases/rejected > /dev/null
  $ cat requests replies | python3 schema.py ../../conformance/schema/step.schema.json --lines | sed 's/^[0-9]*/N/'
  N checked, 0 wrong
