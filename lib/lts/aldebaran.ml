(* {1 Labels} *)

let is_hexadecimal = function '0' .. '9' | 'a' .. 'f' -> true | _ -> false

(* Whether there is an escape at [i]. *)
let escape_at text i =
  i + 3 < String.length text && text.[i] = '\\'
  && text.[i + 1] = 'x'
  && is_hexadecimal text.[i + 2]
  && is_hexadecimal text.[i + 3]

let stands text i = match text.[i] with '"' -> false | ' ' .. '~' -> not (escape_at text i) | _ -> false

let escape text =
  let rec all_stand i = i = String.length text || (stands text i && all_stand (i + 1)) in
  if all_stand 0 then text
  else begin
    let b = Buffer.create (2 * String.length text) in
    String.iteri
      (fun i c ->
         if stands text i then Buffer.add_char b c else Buffer.add_string b (Printf.sprintf "\\x%02x" (Char.code c)))
      text;
    Buffer.contents b
  end

let unescape text =
  if not (String.contains text '\\') then text
  else begin
    let b = Buffer.create (String.length text) in
    let rec go i =
      if i < String.length text then
        if escape_at text i then begin
          Buffer.add_char b (Char.chr (int_of_string ("0x" ^ String.sub text (i + 2) 2)));
          go (i + 4)
        end
        else begin
          Buffer.add_char b text.[i];
          go (i + 1)
        end
    in
    go 0;
    Buffer.contents b
  end

(* {1 Writing} *)

let write out g =
  let labels = Array.init (Graph.labels g) (fun l -> Printf.sprintf ",\"%s\"," (escape (Graph.label g l))) in
  out (Printf.sprintf "des (%d, %d, %d)\n" (Graph.initial g) (Graph.transitions g) (Graph.states g));
  Graph.iter g (fun s l s' ->
      out "(";
      out (string_of_int s);
      out labels.(l);
      out (string_of_int s');
      out ")\n")

let to_string g =
  let b = Buffer.create (32 * (Graph.transitions g + 1)) in
  write (Buffer.add_string b) g;
  Buffer.contents b

(* {1 Reading} *)

type problem =
  | Not_a_header of string
  | Not_a_transition of string
  | Unclosed_label of string
  | No_states
  | Number_too_large of string
  | No_such_state of { state : int; states : int }
  | Wrong_count of { announced : int; found : int }

type error = { line : int; problem : problem }

exception Problem of problem

let fail problem = raise_notrace (Problem problem)

(* [number ~otherwise text] is the number that [text] is, blanks aside, or else the problem is [otherwise]. *)
let number ~otherwise text =
  let text = String.trim text in
  let digit value c =
    match c with
    | '0' .. '9' -> if value > Int_vector.limit then value else (10 * value) + Char.code c - Char.code '0'
    | _ -> fail otherwise
  in
  if text = "" then fail otherwise;
  let value = Seq.fold_left digit 0 (String.to_seq text) in
  if value > Int_vector.limit then fail (Number_too_large text);
  value

(* The text in the parentheses that [text] consists of. *)
let in_parentheses ~otherwise text =
  let text = String.trim text in
  let length = String.length text in
  if length < 2 || text.[0] <> '(' || text.[length - 1] <> ')' then fail otherwise;
  String.sub text 1 (length - 2)

type header = { initial : int; announced : int; states : int }

let header line =
  let otherwise = Not_a_header line in
  let trimmed = String.trim line in
  if String.length trimmed < 3 || String.sub trimmed 0 3 <> "des" then fail otherwise;
  let inside = in_parentheses ~otherwise (String.sub trimmed 3 (String.length trimmed - 3)) in
  match List.map (number ~otherwise) (String.split_on_char ',' inside) with
  | [ initial; announced; states ] ->
    if states = 0 then fail No_states;
    if initial >= states then fail (No_such_state { state = initial; states });
    { initial; announced; states }
  | _ -> fail otherwise

let label ~otherwise text =
  let text = String.trim text in
  let length = String.length text in
  if length = 0 then fail otherwise;
  if text.[0] <> '"' then text
  else if length = 1 || text.[length - 1] <> '"' then fail (Unclosed_label text)
  else unescape (String.sub text 1 (length - 2))

let transition ~states b line =
  let otherwise = Not_a_transition line in
  let inside = in_parentheses ~otherwise line in
  match (String.index_opt inside ',', String.rindex_opt inside ',') with
  | Some first, Some last when first < last ->
    let state text =
      let state = number ~otherwise text in
      if state >= states then fail (No_such_state { state; states });
      state
    in
    let s = state (String.sub inside 0 first) in
    let s' = state (String.sub inside (last + 1) (String.length inside - last - 1)) in
    Graph.Builder.add b s (label ~otherwise (String.sub inside (first + 1) (last - first - 1))) s'
  | _ -> fail otherwise

let read next =
  let at = ref 0 in
  let rec line () =
    incr at;
    match next () with Some text when String.trim text = "" -> line () | text -> text
  in
  let b = Graph.Builder.create () in
  let rec transitions ~states found =
    match line () with
    | None -> found
    | Some text ->
      transition ~states b text;
      transitions ~states (found + 1)
  in
  try
    match line () with
    | None ->
      at := 1;
      fail (Not_a_header "")
    | Some text ->
      let { initial; announced; states } = header text in
      let header_at = !at in
      let found = transitions ~states 0 in
      if found <> announced then begin
        at := header_at;
        fail (Wrong_count { announced; found })
      end;
      Ok (Graph.Builder.finish ~initial ~states b)
  with Problem problem -> Error { line = !at; problem }

let of_string text =
  let length = String.length text and from = ref 0 in
  read (fun () ->
      if !from > length then None
      else begin
        let start = !from in
        let finish = match String.index_from_opt text start '\n' with Some i -> i | None -> length in
        from := finish + 1;
        Some (String.sub text start (finish - start))
      end)

let pp_problem ppf = function
  | Not_a_header text -> Fmt.pf ppf "expected \"des (initial state, transitions, states)\", not %S" text
  | Not_a_transition text -> Fmt.pf ppf "expected (state,\"label\",state), not %S" text
  | Unclosed_label text -> Fmt.pf ppf "the label %s lacks its closing quote" text
  | No_states -> Fmt.string ppf "there must be a state, the initial one"
  | Number_too_large text -> Fmt.pf ppf "the number %s is too large" text
  | No_such_state { state; states } -> Fmt.pf ppf "there is no state %d: there are %d, numbered from 0" state states
  | Wrong_count { announced; found } -> Fmt.pf ppf "%d transitions are announced, but there are %d" announced found

let pp_error ppf { line; problem } = Fmt.pf ppf "line %d: %a" line pp_problem problem
