open Dolphin_semantics
open Core

let case name run = Alcotest.test_case name `Quick run
let plan_site = 100

(* {1 Writing settings} *)

let i n = Integer n
let n x = Number x
let str s = String s
let sym s = Symbol s
let items xs = List (Vector.of_list xs)
let set ?(named = []) setting positional = { setting; positional; named; setting_site = 0 }
let man setting named = set setting [] ~named

(* Each setting's site is its place in the list. *)
let build ?(name = "p") ?(place = Some Dolphin_geo.Place.apdl) settings =
  Plan_builder.build ~name ~place plan_site (List.mapi (fun k s -> { s with setting_site = k }) settings)

let built settings =
  match build settings with Ok plan -> plan | Error fault -> Alcotest.fail fault.message

let go = man "goTo" []
