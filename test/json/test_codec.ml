(* Codecs: what is read, what is written, the path of a fault, the schema. *)

open Dolphin_json

type shape = Circle of float | Line of { from : int; until : int } | Group of shape list

let shape =
  let open Codec in
  fix "shape" (fun shape ->
      let circle = case "circle" (one "radius" (number ~least:0. ())) (fun radius -> Circle radius)
      and line =
        case "line"
          (check
             (fun (from, until) -> if from < until then Ok (from, until) else Error "a line that has no length")
             (one "from" count @& one "until" count))
          (fun (from, until) -> Line { from; until })
      and group = case "group" (one "shapes" (list ~most:2 shape)) (fun shapes -> Group shapes) in
      let choose = function
        | Circle radius -> Is (circle, radius)
        | Line { from; until } -> Is (line, (from, until))
        | Group shapes -> Is (group, shapes)
      in
      record (union ~tag:"kind" [ Case circle; Case line; Case group ] choose))

type drawing = { title : string; size : float option; colours : string list; shapes : shape list }

let drawing =
  let open Codec in
  closed
    (let+ title = field "title" word (fun d -> d.title) ~doc:"for people"
     and+ size = optional "size" ~null:true (decimal ~most:10. ()) (fun d -> d.size)
     and+ colours = default [] "colours" (list text) (fun d -> d.colours)
     and+ shapes = field "shapes" (list shape) (fun d -> d.shapes) in
     { title; size; colours; shapes })

let read text = Codec.read drawing (Yojson.Safe.from_string text)

let whole =
  { title = "a"; size = Some 2.; colours = []; shapes = [ Circle 2.; Group [ Line { from = 1; until = 2 }; Group [] ] ] }

let text =
  {|{"title":"a","size":2.0,"shapes":[{"kind":"circle","radius":2},|}
  ^ {|{"kind":"group","shapes":[{"kind":"line","from":1,"until":2},{"kind":"group","shapes":[]}]}]}|}

let writes () =
  Alcotest.(check string) "the text" text (Codec.to_string drawing whole);
  Alcotest.(check bool) "is read as the same" true (read text = Ok whole)

let accepts () =
  let plain = { title = "a"; size = None; colours = []; shapes = [] } in
  let same what text = Alcotest.(check bool) what true (read text = Ok plain) in
  same "in any order" {|{"shapes":[],"title":"a"}|};
  same "null as absent" {|{"shapes":[],"title":"a","size":null}|};
  same "a default that is there" {|{"shapes":[],"title":"a","colours":[]}|}

let faults =
  [ ({|[]|}, {|[], not an object|});
    ({|{"shapes":[]}|}, {|"title" is missing|});
    ({|{"title":"","shapes":[]}|}, {|"title" is empty|});
    ({|{"title":"a","size":11,"shapes":[]}|}, {|"size" is 11, not a number up to 10|});
    ({|{"title":"a","colours":null,"shapes":[]}|}, {|"colours" is null, not a list|});
    ({|{"title":"a","colours":["b",2],"shapes":[]}|}, {|"colours[1]" is 2, not a text|});
    ({|{"title":"a","shapes":[],"author":"b"}|}, {|"author" is not a known member|});
    ({|{"title":"a","shapes":[{}]}|}, {|"shapes[0].kind" is missing|});
    ({|{"title":"a","shapes":[{"kind":"dot"}]}|}, {|"shapes[0].kind" is 'dot', not one of circle, line, group|});
    ( {|{"title":"a","shapes":[{"kind":"group","shapes":[{"kind":"circle","radius":-1}]}]}|},
      {|"shapes[0].shapes[0].radius" is -1, not a number from 0|} );
    ({|{"title":"a","shapes":[{"kind":"line","from":1,"until":1}]}|}, {|"shapes[0]" is a line that has no length|});
    ( {|{"title":"a","shapes":[{"kind":"group","shapes":[{},{},{}]}]}|},
      {|"shapes[0].shapes" is a list of 3, not of a number up to 2|} ) ]

let fault (text, why) =
  Alcotest.test_case text `Quick (fun () ->
      Alcotest.(check (result reject string)) "the fault" (Error why) (read text))

let schema =
  {|{"$schema":"https://json-schema.org/draft/2020-12/schema","title":"Drawings","type":"object",|}
  ^ {|"properties":{"title":{"type":"string","minLength":1,"description":"for people"},|}
  ^ {|"size":{"type":"number","maximum":10},"colours":{"type":"array","items":{"type":"string"}},|}
  ^ {|"shapes":{"type":"array","items":{"$ref":"#/$defs/shape"}}},"required":["title","shapes"],|}
  ^ {|"additionalProperties":false,"$defs":{"shape":{"type":"object","oneOf":[|}
  ^ {|{"properties":{"kind":{"const":"circle"},"radius":{"type":"number","minimum":0}},"required":["kind","radius"]},|}
  ^ {|{"properties":{"kind":{"const":"line"},"from":{"type":"integer","minimum":0},|}
  ^ {|"until":{"type":"integer","minimum":0}},"required":["kind","from","until"]},|}
  ^ {|{"properties":{"kind":{"const":"group"},"shapes":{"type":"array","items":{"$ref":"#/$defs/shape"},|}
  ^ {|"maxItems":2}},"required":["kind","shapes"]}]}}}|}

let described () =
  Alcotest.(check string) "the schema" schema (Canonical.to_string (Codec.schema ~title:"Drawings" drawing))

(* Lists are read and written without stack for each element. *)
let long () =
  let numbers = List.init 1_000_000 Fun.id in
  let codec = Codec.(list count) in
  Alcotest.(check bool) "the same" true (Codec.read codec (Codec.write codec numbers) = Ok numbers)

let () =
  let case name f = Alcotest.test_case name `Quick f in
  Alcotest.run "codec"
    [ ("values", [ case "written" writes; case "accepted" accepts; case "long lists" long ]);
      ("faults", List.map fault faults);
      ("schema", [ case "of all" described ]) ]
