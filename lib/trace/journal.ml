type item =
  | Line of { number : int; entry : Entry.t }
  | Torn of int
  | End_of_file
  | Wrong of { number : int; why : string }

type t = {
  input : bytes -> int -> int -> int;
  chunk : bytes;
  mutable from : int;
  mutable until : int;
  line : Buffer.t;  (* the part of the line in earlier chunks *)
  mutable number : int;
  mutable whole : int;  (* bytes of the lines that had an end *)
  mutable notes : int;  (* lines of the platform *)
  mutable ahead : item option;  (* read already, for [peek] *)
}

let longest = 16 * 1024 * 1024

let make input =
  { input; chunk = Bytes.create 65536; from = 0; until = 0; line = Buffer.create 1024; number = 0; whole = 0;
    notes = 0; ahead = None }

let of_channel channel = make (input channel)

let of_string text =
  let at = ref 0 in
  let input bytes from length =
    let n = min length (String.length text - !at) in
    Bytes.blit_string text !at bytes from n;
    at := !at + n;
    n
  in
  make input

(* Bytes of the chunk up to its first line break, if it has one. *)
let in_chunk r =
  match Bytes.index_from r.chunk r.from '\n' with
  | stop when stop < r.until -> Some (stop - r.from)
  | _ | (exception Not_found) -> None

type text = Whole of string | Unfinished of string | Too_long

let rec read r =
  match in_chunk r with
  | Some length ->
    Buffer.add_subbytes r.line r.chunk r.from length;
    r.from <- r.from + length + 1;
    let text = Buffer.contents r.line in
    Buffer.clear r.line;
    r.whole <- r.whole + String.length text + 1;
    Whole text
  | None ->
    Buffer.add_subbytes r.line r.chunk r.from (r.until - r.from);
    r.from <- 0;
    r.until <- r.input r.chunk 0 (Bytes.length r.chunk);
    if Buffer.length r.line > longest then Too_long
    else if r.until > 0 then read r
    else
      let text = Buffer.contents r.line in
      Buffer.clear r.line;
      Unfinished text

let whole r = r.whole
let notes r = r.notes

let one_more (entry : Entry.t) = match entry with Note _ -> 1 | _ -> 0

let missing ~expected found =
  Printf.sprintf
    "%s of the platform before this line, not %d: the journal is damaged, and the orders to vehicles are not known"
    (Phrase.count found "line") expected

let read_next r =
  r.number <- r.number + 1;
  let number = r.number in
  let wrong why = Wrong { number; why } in
  let entry text ~otherwise =
    let first text = Result.map (fun entry -> (entry, None)) (Entry.first_of_string text) in
    match if number = 1 then first text else Entry.of_numbered_string text with
    | Ok (Header _, _) when number > 1 -> wrong "a second header"
    | Ok (_, Some expected) when expected <> r.notes -> wrong (missing ~expected r.notes)
    | Ok (entry, _) ->
      r.notes <- r.notes + one_more entry;
      Line { number; entry }
    | Error why -> otherwise why
  in
  match read r with
  | Too_long -> wrong "this line is longer than 16 MiB"
  | Whole text -> entry text ~otherwise:wrong
  | Unfinished "" -> if number = 1 then wrong "the journal is empty" else End_of_file
  | Unfinished text ->
    (* The rest of a line is never a whole line of JSON. *)
    let first = "this is not a journal, or its first line is incomplete" in
    entry text ~otherwise:(fun _ -> if number = 1 then wrong first else Torn number)

let next r =
  match r.ahead with
  | Some item -> r.ahead <- None; item
  | None -> read_next r

let peek r =
  let item = next r in
  r.ahead <- Some item;
  item

let breaks_off channel =
  let r = of_channel channel in
  let rec is_begun () =
    match next r with
    | Line { entry = Transition _; _ } -> true
    | Line _ -> is_begun ()
    | Torn _ | End_of_file | Wrong _ -> false
  in
  let rec is_open last =
    match read r with
    | Whole text -> is_open text
    | Unfinished "" -> (match Entry.of_string last with Ok (End _) -> false | Ok _ | Error _ -> true)
    | Unfinished _ | Too_long -> true
  in
  match next r with
  | Line { entry = Header _; _ } -> is_begun () && is_open ""
  | Line _ | Torn _ | End_of_file | Wrong _ -> false

(* {1 Writing} *)

type numbering = { mutable so_far : int; mutable written : int }

let numbering ~notes = { so_far = notes; written = 0 }

let line n (entry : Entry.t) =
  let notes = if n.so_far = n.written then None else Some n.so_far in
  match entry with
  | Note _ -> n.so_far <- n.so_far + 1; Entry.to_string ?notes entry
  | _ -> n.written <- n.so_far; Entry.to_string ?notes entry
