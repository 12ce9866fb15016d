module Search = Dolphin_explore.Search
module Property = Dolphin_explore.Property
module Phrase = Dolphin_trace.Phrase

type tree = Element of string * (string * string) list * tree list | Text of string

let rec output out = function
  | Text text -> Xmlm.output out (`Data (Phrase.harmless text))
  | Element (name, attributes, inside) ->
    let attribute (name, value) = (("", name), Phrase.one_line value) in
    Xmlm.output out (`El_start (("", name), List.map attribute attributes));
    List.iter (output out) inside;
    Xmlm.output out `El_end

let findings ~strict ~fairness (p : Program_file.t) (property, (verdict : Search.verdict)) =
  let message = Format.asprintf "%a" (Search.pp_verdict ~fairness p.program) (property, verdict) in
  let violated details =
    if strict || not (Exploration.is_remark property) then
      [ Element ("failure", [ ("message", message); ("type", Property.name property) ], [ Text details ]) ]
    else [ Element ("system-out", [], [ Text (message ^ details) ]) ]
  in
  match verdict with
  | Holds -> []
  | Holds_if _ | By_design _ -> [ Element ("system-out", [], [ Text message ]) ]
  | Violated run -> violated ("\n" ^ Run_columns.text ?decided:run.decided p ~steps:run.steps ~cycle:run.cycle ^ "\n")
  | Unreached _ -> violated ""
  | Inconclusive _ -> [ Element ("error", [ ("message", message); ("type", "inconclusive") ], []) ]

let suite ~strict (p : Program_file.t) (o : Search.outcome) =
  let case ((property, _) as verdict) =
    let found = findings ~strict ~fairness:o.fairness p verdict in
    (Element ("testcase", [ ("classname", p.path); ("name", Property.name property) ], found), found)
  in
  let cases = List.map case o.verdicts in
  let having name =
    let is_it = function Element (name', _, _) -> name' = name | Text _ -> false in
    string_of_int (List.length (List.filter (fun (_, found) -> List.exists is_it found) cases))
  in
  let counts =
    [ ("tests", string_of_int (List.length cases)); ("failures", having "failure"); ("errors", having "error");
      ("time", Printf.sprintf "%.3f" o.seconds) ]
  in
  Element ("testsuites", counts, [ Element ("testsuite", ("name", p.path) :: counts, List.map fst cases) ])

let write ~strict p path o =
  Text_file.write path (fun channel ->
      let out = Xmlm.make_output ~nl:true ~indent:(Some 2) (`Channel channel) in
      Xmlm.output out (`Dtd None);
      output out (suite ~strict p o))
