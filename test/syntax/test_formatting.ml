(* Formatting keeps programs and comments, and is idempotent. *)

open Dolphin_syntax

let file = "formatted.dol"

let arranged source =
  match Formatting.arranged ~file source with
  | Ok text -> text
  | Error _ -> Alcotest.failf "not read: %s" source

(* How often [word] stands in [text]. *)
let count word text =
  let n = String.length word in
  let rec go i found =
    if i + n > String.length text then found
    else go (i + 1) (if String.sub text i n = word then found + 1 else found) in
  go 0 0

let comments = [ "/*c*/"; "//c"; "/*b\n*/" ]

let erased text =
  match Parse.program ~file text with
  | Ok program -> Some (Erase.program program)
  | Error _ -> None

(* Everything that holds of formatting the program [source]; texts that are not programs are skipped. *)
let holds source =
  match erased source with
  | None -> true
  | Some program ->
    let text = arranged source in
    erased text = Some program
    && arranged text = text
    && Formatting.program ~file source = Ok text
    && List.for_all (fun c -> count c source = count c text) comments

(* A program in a careless layout: with breaks, blanks, semicolons and comments anywhere. *)
let disarranged =
  let open QCheck2.Gen in
  let insertion = pair (int_bound 1_000_000) (oneofl ([ "\n"; "\n"; "\n\n\n"; "  "; "\t"; ";"; "; "; "\r\n"; "//c\n" ] @ comments)) in
  let insert text (at, what) =
    (* At a blank: elsewhere the result is rarely a program. *)
    let length = String.length text in
    let rec blank i fuel =
      if fuel = 0 then i
      else if text.[i] = ' ' || text.[i] = '\n' then i
      else blank ((i + 1) mod length) (fuel - 1) in
    if length = 0 then text
    else
      let at = blank (at mod length) 40 in
      String.sub text 0 at ^ what ^ String.sub text at (length - at) in
  map2 (fun program insertions -> List.fold_left insert (Support.printed program) insertions)
    Generate.program (list_size (int_bound 6) insertion)

let print source = source ^ "\n---- becomes\n" ^ (match erased source with None -> "" | Some _ -> arranged source)

let formats name source expected =
  let check () =
    Alcotest.(check string) "formatted" expected (arranged source);
    Alcotest.(check bool) "for good" true (holds source) in
  Alcotest.test_case name `Quick check

let long_tasks =
  formats "long lines are ended where they are loosest"
    "execute planes: firstTask('north') | secondTask('east') | thirdTask('south') | fourthTask('west'), boats: rescue() | rescue() | rescue()\n"
    "execute planes: firstTask('north') | secondTask('east') | thirdTask('south') | fourthTask('west'),\n\
    \        boats: rescue() | rescue() | rescue()\n"

let long_body =
  formats "a body that is too long gets a line for each statement"
    "vehicle 'noptilus-1', { type 'UUV'; payload 'DVL', 'Sidescan'; at 41.18501, -8.70601; speed 1.5; battery 80.percent; drops 2.min, 3.min }\n"
    "vehicle 'noptilus-1', {\n    type 'UUV'\n    payload 'DVL', 'Sidescan'\n    at 41.18501, -8.70601\n    speed 1.5\n\
    \    battery 80.percent\n    drops 2.min, 3.min\n}\n"

let spacing =
  formats "blanks" "x=-1+ (2*3)\nf ( x,y:2 ) [ 1 ]\nif(a){b  }\nelse  {c}\nm=[ : ]\nxs=[1 ..3 , 4]\nz=!a&&- b\ni ++\nexecute (a|b)>>c\nexecute (a|b)until{ c }\nexecute (a)\nregion (a+b).hull( )\nif(c) { d }\n"
    "x = -1 + (2 * 3)\nf(x, y: 2)[1]\nif (a) { b } else { c }\nm = [:]\nxs = [1..3, 4]\nz = !a && -b\ni++\nexecute (a | b) >> c\nexecute (a | b) until { c }\nexecute(a)\nregion (a + b).hull()\nif (c) { d }\n"

let repository =
  let formats path () = Alcotest.(check bool) path true (holds (Support.read_file path)) in
  let folders =
    [ "../../examples"; "../../examples/missions"; "../../examples/related"; "good"; "../../templates/mission" ] in
  let is_program path = Filename.check_suffix path ".dol" || Filename.check_suffix path ".fleet" in
  let files folder =
    let names = List.sort compare (Array.to_list (Sys.readdir folder)) in
    List.filter is_program (List.map (Filename.concat folder) names) in
  List.map (fun path -> Alcotest.test_case path `Quick (formats path)) (List.concat_map files folders)

let suite =
  [ Test_support.Property.case "what is printed" ~count:600 Generate.program
      ~print:(fun p -> print (Support.printed p)) (fun p -> holds (Support.printed p));
    Alcotest.test_case "a comment, and a separator before the brace" `Quick (fun () ->
        Alcotest.(check bool) "holds" true (holds "{//c\n\n; }\n\n\nnull\nnull\n"));
    Test_support.Property.case "programs in any layout" ~count:400 disarranged ~print holds;
    long_tasks; long_body; spacing ]
  @ repository
