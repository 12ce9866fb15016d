open Dolphin_syntax.Ast
module Diagnostic = Dolphin_syntax.Diagnostic

(* {1 Numbers of vehicles} *)

(* How many vehicles a [pick] with these settings gives, if that is written there. *)
let picked body =
  let rec go n = function
    | [] -> Some n
    | (s : statement) :: rest -> (
        match s.it with
        | Expression { it = Call { callee = { it = Variable "count"; _ }; arguments }; _ } -> (
            match arguments with [ Positional { it = Integer n; _ } ] -> go n rest | _ -> None)
        | Setting ({ it = "count"; _ }, { it = Integer n; _ }) -> go n rest
        | Setting ({ it = "count"; _ }, _) -> None
        | Expression _ | Setting _ -> go n rest
        | Assign _ | Define _ | Parameter _ | Function _ | If _ | While _ | For _ | Return _ | Break | Continue
        | Block _ -> None)
  in
  go 1 body

let rec assigned_picks found (s : statement) =
  match s.it with
  | Assign { target = { it = Variable v; _ }; value = { it = Builder (Pick, body); _ }; operator = None }
  | Define ({ it = v; _ }, Some { it = Builder (Pick, body); _ }) -> (
      match picked body with Some n -> (v, n) :: found | None -> found)
  | Block body | While (_, body) | For (_, _, body) | Function { body; _ } -> List.fold_left assigned_picks found body
  | If (_, yes, no) -> List.fold_left assigned_picks found (yes @ no)
  | _ -> found

(* {1 Tasks} *)

(* At least this number of vehicles at once. [execute (a | b)[v]] is read as an [execute] and an index: the text
   after the parentheses is part of its argument. *)
let rec width (e : expression) =
  match e.it with
  | Builder ((Imc_plan | Mission), _) | Call { callee = { it = Variable ("task" | "imcPlan"); _ }; _ } -> 1
  | Call { callee = { it = Variable "execute"; _ }; arguments = [ Positional a ] } -> width a
  | Binary (Parallel, a, b) -> width a + width b
  | Binary (Sequence, a, b) -> max (width a) (width b)
  | Binary (Divide, a, _) | Index (a, _) | Until (_, _, a) | During (_, _, a) | Watch (a, _) | Wait_for (_, a)
  | Ensure (a, _) | Repeat { body = a; _ } -> width a
  | _ -> 0

(* The single vehicles that a task surely runs on, each with its place in the text. *)
let rec surely singles (e : expression) =
  match e.it with
  | Index (a, { it = Variable v; at }) when List.mem v singles && width a > 0 -> [ (v, at) ]
  | Index (a, _) | Binary (Divide, a, _) | Until (_, _, a) | During (_, _, a) | Watch (a, _) | Wait_for (_, a)
  | Ensure (a, _) | Repeat { body = a; _ } -> surely singles a
  | Binary ((Sequence | Parallel), a, b) -> surely singles a @ surely singles b
  | Call { callee = { it = Variable "execute"; _ }; arguments = [ Positional a ] } -> surely singles a
  | _ -> []

let twice at v =
  Diagnostic.error ~code:Vehicle_twice at
    (Printf.sprintf "vehicle '%s' is given to two tasks that run side by side" v)
    ~hint:"tasks of one vehicle follow each other by >>"

let clashes singles branches =
  let rec from seen = function
    | [] -> []
    | branch :: rest ->
      let here = surely singles branch in
      let clash = List.filter (fun (v, _) -> List.mem_assoc v seen) here in
      List.map (fun (v, at) -> twice at v) clash @ from (here @ seen) rest
  in
  from [] branches

let named_clashes singles arguments =
  let rec from seen = function
    | Named (k, e) :: rest when List.mem k.it singles && width e > 0 ->
      let here = if List.mem k.it seen then [ twice k.at k.it ] else [] in
      here @ from (k.it :: seen) rest
    | _ :: rest -> from seen rest
    | [] -> []
  in
  from [] arguments

let vehicles n = if n = 1 then "one vehicle" else Printf.sprintf "%d vehicles" n

let too_narrow at (v, n) needed =
  Diagnostic.error ~code:Vehicle_twice at
    (Printf.sprintf "'%s' is %s, and the task needs %d at the same time" v (vehicles n) needed)
    ~hint:(if n = 1 then "tasks of one vehicle follow each other by >>"
           else Printf.sprintf "pick as many, as in count %d; tasks that follow each other by >> share vehicles" needed)

(* {1 One of several} *)

let of_one = [ "position"; "battery"; "speed"; "connected"; "reading"; "eta"; "running" ]
let members_of_one = [ "position"; "battery"; "id"; "type"; "payload" ]

let several at v n what =
  Diagnostic.error ~code:Wrong_value at (Printf.sprintf "'%s' is %s, and %s is of one" v (vehicles n) what)
    ~hint:(Printf.sprintf "the first is %s[0]; %s.every { x -> ... } and %s.any { x -> ... } ask of all" v v v)

let beyond at v n i =
  Diagnostic.error ~code:Wrong_value at (Printf.sprintf "'%s' is %s: %s[%d] does not exist" v (vehicles n) v i)
    ~hint:(Printf.sprintf "the first is %s[0], the last %s[%d]" v v (n - 1))

let look_at_one counts functions acc (e : expression) =
  let count v = List.assoc_opt v counts in
  match e.it with
  | Call { callee = { it = Variable f; _ }; arguments = Positional { it = Variable v; _ } :: _ }
    when List.mem f of_one && not (List.mem f functions) -> (
      match count v with Some n when n > 1 -> several e.at v n f :: acc | Some _ | None -> acc)
  | Member { subject = { it = Variable v; _ }; name; safe = false } when List.mem name.it members_of_one -> (
      match count v with Some n when n > 1 -> several e.at v n name.it :: acc | Some _ | None -> acc)
  | Index ({ it = Variable v; _ }, { it = Integer i; _ }) -> (
      match count v with Some n when i >= n -> beyond e.at v n i :: acc | Some _ | None -> acc)
  | _ -> acc

let at_expression counts singles acc (e : expression) =
  let short v needed = match List.assoc_opt v counts with Some n when needed > n -> Some (v, n) | _ -> None in
  match e.it with
  | Binary (Parallel, a, b) -> clashes singles [ a; b ] @ acc
  | Index (a, { it = Variable v; at }) when short v (width a) <> None ->
    Option.fold (short v (width a)) ~none:acc ~some:(fun short -> too_narrow at short (width a) :: acc)
  | Call { callee = { it = Variable "execute"; _ }; arguments } ->
    let narrow = function
      | Named (k, e) -> Option.map (fun short -> too_narrow k.at short (width e)) (short k.it (width e))
      | Positional _ | Keyed _ -> None
    in
    List.filter_map narrow arguments @ named_clashes singles arguments @ acc
  | _ -> acc

let program ast =
  let is_pick (e : expression) = match e.it with Builder (Pick, body) -> picked body <> None | _ -> false in
  let once = Assigned.once is_pick ast in
  if Assigned.Names.is_empty once then []
  else
    let counts = List.filter (fun (v, _) -> Assigned.Names.mem v once) (List.fold_left assigned_picks [] ast) in
    let singles = List.filter_map (fun (v, n) -> if n = 1 then Some v else None) counts in
    let functions = Constants.function_names ast in
    let look acc e = look_at_one counts functions (at_expression counts singles acc e) e in
    List.fold_left (Fold.statement look) [] ast
