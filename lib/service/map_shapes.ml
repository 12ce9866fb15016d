open Dolphin_syntax
open Ast
module Area = Dolphin_geo.Area
module Position = Dolphin_geo.Position
module Constants = Dolphin_semantics.Constants
module Core = Dolphin_semantics.Core
module Value = Dolphin_semantics.Value

type span = Occurrences.span = { start : int; stop : int }
type number = { span : span; negative : bool }
type point = { at : Position.t; coordinates : (number * number) option }

type form =
  | Spot of point
  | Way of point list
  | Plan of point list
  | Rings of point list list
  | Round of { centre : point; radius : float; metres : number option }
  | Computed of Area.t

type t = { name : string; form : form; span : span }

type env = { source : string; constants : Constants.t; own : string list  (* names that the program defines *) }

let most_points = 2_000
let span_of (at : Location.t) = { start = at.start.pos_cnum; stop = at.stop.pos_cnum }

(* {1 Numbers} *)

(* Behind a name without parentheses a minus sign is a subtraction. *)
let may_be_negative source start =
  let rec before i = if i > 0 && (source.[i - 1] = ' ' || source.[i - 1] = '\n') then before (i - 1) else i in
  let i = before start in
  i > 0 && List.mem source.[i - 1] [ '('; ','; '['; ':' ]

let number env (e : expression) =
  let found x =
    let span = span_of e.at in
    Some (x, { span; negative = may_be_negative env.source span.start }) in
  match e.it with
  | Integer n -> found (float_of_int n)
  | Number x -> found x
  | Unary (Negate, { it = Integer n; _ }) -> found (-.float_of_int n)
  | Unary (Negate, { it = Number x; _ }) -> found (-.x)
  | _ -> None

let metres env (e : expression) =
  match e.it with
  | Member { subject; name = { it = "m"; _ }; safe = false } -> number env subject
  | _ -> number env e

(* {1 Positions} *)

let is_given env name = not (List.mem name env.own)

let known_position env e =
  match Constants.value env.constants e with
  | Ok (Core.Position p) -> Some { at = p; coordinates = None }
  | Ok _ | Error _ -> None

let of_numbers env latitude longitude =
  match number env latitude, number env longitude with
  | Some (x, latitude), Some (y, longitude) -> (
      match Position.make ~latitude:x ~longitude:y ~height:0. with
      | Ok at -> Some { at; coordinates = Some (latitude, longitude) }
      | Error _ -> None)
  | _, _ -> None

let setting name (s : statement) =
  match s.it with
  | Setting (k, e) when k.it = name -> Some e
  | Expression { it = Call { callee = { it = Variable x; _ }; arguments = [ Positional e ] }; _ } when x = name ->
    Some e
  | _ -> None

let literal_position env (e : expression) =
  match e.it with
  | Call { callee = { it = Variable "location"; _ }; arguments = Positional latitude :: Positional longitude :: _ }
    when is_given env "location" ->
    of_numbers env latitude longitude
  | Builder (Pos, body) -> (
      match List.filter_map (setting "lat") body, List.filter_map (setting "lon") body with
      | [ latitude ], [ longitude ] -> of_numbers env latitude longitude
      | _, _ -> None)
  | _ -> None

let position env e = match literal_position env e with Some p -> Some p | None -> known_position env e

let positions env es =
  let found = List.filter_map (position env) es in
  if List.length found = List.length es then Some found else None

let is_written p = p.coordinates <> None

(* {1 Shapes} *)

(* The argument of [locate], in one piece or in two. *)
let located_at env (s : statement) =
  match s.it with
  | Setting ({ it = "locate"; _ }, e) -> position env e
  | Expression { it = Call { callee = { it = Variable "locate"; _ }; arguments }; _ } when is_given env "locate" -> (
      match arguments with
      | [ Positional e ] -> position env e
      | Positional latitude :: Positional longitude :: _ -> of_numbers env latitude longitude
      | _ -> None)
  | _ -> None

let place_of_maneuver env (s : statement) =
  match s.it with
  | Expression { it = Call { callee = { it = Variable _; _ }; arguments }; _ } ->
    let place = function Named ({ it = "location"; _ }, e) -> position env e | _ -> None in
    (match List.filter_map place arguments with p :: _ -> Some p | [] -> None)
  | _ -> None

let places env body =
  let place s = match located_at env s with Some p -> Some p | None -> place_of_maneuver env s in
  List.filter_map place body

let rec holes env = function
  | Named ({ it = "holes"; _ }, { it = List rings; _ }) :: rest ->
    let ring (e : expression) = match e.it with List es -> positions env es | _ -> None in
    List.filter_map ring rings @ holes env rest
  | _ :: rest -> holes env rest
  | [] -> []

let round env centre radius =
  let known e =
    match Constants.value env.constants e with Ok x -> Value.to_number x | Error _ -> None in
  match position env centre, metres env radius, known radius with
  | Some centre, Some (radius, metres), _ when radius > 0. -> Some (Round { centre; radius; metres = Some metres })
  | Some centre, None, Some radius when radius > 0. -> Some (Round { centre; radius; metres = None })
  | _, _, _ -> None

let form env (e : expression) =
  match e.it with
  | Call { callee = { it = Variable "polygon"; _ }; arguments = Positional { it = List es; _ } :: rest }
    when is_given env "polygon" ->
    Option.map (fun rim -> Rings (rim :: holes env rest)) (positions env es)
  | Call { callee = { it = Variable "area"; _ }; arguments = [ Positional centre; Positional radius ] }
    when is_given env "area" ->
    round env centre radius
  | Binary (Around, centre, radius) -> round env centre radius
  | List (_ :: _ :: _ as es) when List.exists (fun e -> literal_position env e <> None) es ->
    Option.map (fun points -> Way points) (positions env es)
  | Builder (Imc_plan, body) -> (match places env body with [] -> None | points -> Some (Plan points))
  | _ -> Option.map (fun p -> Spot p) (literal_position env e)

let points = function
  | Spot p -> [ p ]
  | Way ps | Plan ps -> ps
  | Rings rings -> List.concat rings
  | Round { centre; _ } -> [ centre ]
  | Computed _ -> []

let is_movable = function
  | Round { metres = Some _; _ } -> true
  | form -> List.exists is_written (points form)

let plan_name body =
  let name s = match setting "planName" s with Some { it = String x; _ } -> Some x | Some _ | None -> None in
  List.find_map name body

let word (e : expression) =
  match e.it with
  | Call { callee = { it = Variable x; _ }; _ } -> x
  | Builder (Imc_plan, _) -> "imcPlan"
  | Builder (Pos, _) -> "pos"
  | _ -> ""

(* {1 The program} *)

let name_of (name : string) (e : expression) =
  match e.it with
  | Builder (Imc_plan, body) -> Option.value (plan_name body) ~default:(if name = "" then word e else name)
  | _ -> if name = "" then word e else name

let known_form env (e : expression) =
  match Constants.value env.constants e with
  | Ok (Core.Area area) -> Some (Computed area)
  | Ok (Core.Position at) -> Some (Spot { at; coordinates = None })
  | Ok _ | Error _ -> None

let assigned (s : statement) =
  match s.it with
  | Assign { target = { it = Variable x; _ }; operator = None; value = e }
  | Define ({ it = x; _ }, Some e)
  | Parameter { name = { it = x; _ }; value = e; description = _ } ->
    Some (x, e)
  | _ -> None

(* Each position in plain numbers belongs to one shape. *)
let rec within env name (e : expression) =
  let children = List.concat_map (node env name) (Well_formed.children (Expression_node e)) in
  match form env e, e.it with
  | Some (Plan _ as form), Builder (_, body) ->
    let name = name_of name e in
    let own = { name; form; span = span_of e.at } in
    let rest = List.concat_map (of_maneuver env name) body in
    if is_movable form then own :: rest else rest
  | Some form, _ when is_movable form -> [ { name = name_of name e; form; span = span_of e.at } ]
  | (Some _ | None), _ -> children

(* Shapes of a maneuver besides its place, such as the corners of an area to survey. *)
and of_maneuver env name (s : statement) =
  let latitudes ps = List.filter_map (fun p -> Option.map (fun ((x : number), _) -> x.span) p.coordinates) ps in
  let taken = latitudes (List.filter_map Fun.id [ located_at env s; place_of_maneuver env s ]) in
  let is_taken shape =
    let own = latitudes (points shape.form) in
    own <> [] && List.for_all (fun span -> List.mem span taken) own in
  List.filter (fun shape -> not (is_taken shape)) (statement env name s)

and node env name = function
  | Well_formed.Expression_node e -> within env name e
  | Statement_node s -> statement env name s

and statement env name (s : statement) =
  match assigned s, located_at env s with
  | Some (x, e), _ -> (
      match within env x e, known_form env e with
      | [], Some form -> [ { name = x; form; span = span_of e.at } ]
      | found, (Some _ | None) -> found)
  | None, Some ({ coordinates = Some _; _ } as p) -> [ { name = "locate"; form = Spot p; span = span_of s.at } ]
  | None, (Some _ | None) -> List.concat_map (node env name) (Well_formed.children (Statement_node s))

let rec first_points n = function
  | [] -> []
  | shape :: rest ->
    let n = n - List.length (points shape.form) in
    if n < 0 then [] else shape :: first_points n rest

let of_program ~source ~chart ~place ast =
  let names = List.map (fun (b : Occurrences.binding) -> b.name) (Occurrences.of_program ~source ast) in
  let env = { source; constants = Constants.of_program ~chart ~place ast; own = names } in
  List.concat_map (statement env "") ast
  |> List.sort (fun a b -> compare a.span.start b.span.start)
  |> first_points most_points
