type t = Can of string * t list | Not of t

(* In continuation-passing style, as formulas may be as deep as graphs are. *)
let holds_within ~steps g s f =
  let steps = ref steps in
  let rec holds s f return =
    decr steps;
    match f with
    | _ when !steps < 0 -> None
    | Not f -> holds s f (fun truth -> return (not truth))
    | Can (label, fs) ->
      let rec any e =
        if e = Graph.first g (s + 1) then return false
        else if String.equal (Graph.label g (Graph.label_of g e)) label then
          all (Graph.target g e) fs (fun truth -> if truth then return true else any (e + 1))
        else any (e + 1)
      in
      any (Graph.first g s)
  and all s fs return =
    match fs with
    | [] -> return true
    | f :: fs -> holds s f (fun truth -> if truth then all s fs return else return false)
  in
  holds s f Option.some

let holds g s f = holds_within ~steps:max_int g s f = Some true

let depth f =
  let rec deepest best = function
    | [] -> best
    | (f, above) :: rest -> (
        match f with
        | Not f -> deepest best ((f, above) :: rest)
        | Can (_, fs) ->
          let here = above + 1 in
          deepest (max best here) (List.rev_append (List.rev_map (fun f -> (f, here)) fs) rest))
  in
  deepest 0 [ (f, 0) ]

let parts_printed = 1000

type token = Text of string | Formula of t

let rec tokens_of = function
  | [] -> []
  | [ f ] -> [ Formula f ]
  | f :: fs -> Formula f :: Text " and " :: tokens_of fs

let pp ppf f =
  let rec print parts = function
    | [] -> ()
    | _ :: _ when parts = parts_printed -> Fmt.string ppf "..."
    | Text text :: rest ->
      Fmt.string ppf text;
      print parts rest
    | Formula (Not f) :: rest ->
      Fmt.string ppf "not ";
      print parts (Formula f :: rest)
    | Formula (Can (label, fs)) :: rest -> (
        Fmt.pf ppf "<%s>" (Dolphin_utf8.Utf8.line label);
        let parts = parts + 1 in
        match fs with
        | [] -> print parts rest
        | [ f ] -> print parts (Text " " :: Formula f :: rest)
        | fs -> print parts ((Text "(" :: tokens_of fs) @ (Text ")" :: rest)))
  in
  print 0 [ Formula f ]
