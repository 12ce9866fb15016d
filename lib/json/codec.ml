type json = Yojson.Safe.t

(* {1 Faults} *)

type step = Member of string | Item of int

type fault = { path : step list; why : string }

let ( let* ) = Result.bind
let wrong why = Error { path = []; why }
let below step = function Ok _ as ok -> ok | Error fault -> Error { fault with path = step :: fault.path }

let text_of_fault { path; why } =
  let step is_first = function
    | Member name when is_first -> name
    | Member name -> "." ^ name
    | Item i -> Printf.sprintf "[%d]" i
  in
  match path with
  | [] -> why
  | first :: rest -> Printf.sprintf "%S is %s" (String.concat "" (step true first :: List.map (step false) rest)) why

let not_a what json = wrong (Printf.sprintf "%s, not %s" (Canonical.shortened 40 json) what)

(* {1 Schemas} *)

(* Definitions are in the order in which they are first referred to; each comes with those that it refers to. *)
type schema = { keywords : (string * json) list; definitions : (string * json) list }

let plain keywords = { keywords; definitions = [] }
let typed name keywords = plain (("type", `String name) :: keywords)
let json_of schema : json = `Assoc schema.keywords
let texts names : json = `List (List.map (fun name -> `String name) names)

let together definitions =
  let add found (name, schema) =
    match List.assoc_opt name found with
    | None -> (name, schema) :: found
    | Some other when other = schema -> found
    | Some _ -> invalid_arg (Printf.sprintf "Codec: two definitions of %S" name)
  in
  List.rev (List.fold_left add [] (List.concat definitions))

(* [null] is allowed by a name among types if there are types, and as a possibility if not. *)
let or_null schema =
  match schema.keywords with
  | ("type", `String name) :: rest when not (List.mem_assoc "enum" rest) ->
    { schema with keywords = ("type", texts [ name; "null" ]) :: rest }
  | _ -> { schema with keywords = [ ("oneOf", `List [ json_of schema; `Assoc [ ("type", `String "null") ] ]) ] }

type 'a t = {
  read : json -> ('a, fault) result;
  write : 'a -> json;
  schema : schema Lazy.t;
}

let read codec json = Result.map_error text_of_fault (codec.read json)
let write codec x = codec.write x
let to_string codec x = Canonical.to_string (codec.write x)

let schema ~title codec : json =
  let { keywords; definitions } = Lazy.force codec.schema in
  let head = [ ("$schema", `String "https://json-schema.org/draft/2020-12/schema"); ("title", `String title) ] in
  `Assoc (head @ keywords @ if definitions = [] then [] else [ ("$defs", `Assoc definitions) ])

(* {1 Values} *)

let make read write schema = { read; write; schema = Lazy.from_val schema }

let text =
  make (function `String text -> Ok text | json -> not_a "a text" json) (fun text -> `String text) (typed "string" [])

let limited keywords codec =
  let schema =
    lazy
      (let schema = Lazy.force codec.schema in
       { schema with keywords = schema.keywords @ keywords })
  in
  { codec with schema }

let described doc = limited [ ("description", `String doc) ]

let refine check keywords codec =
  let read json =
    let* x = codec.read json in
    match check x with None -> Ok x | Some why -> wrong why
  in
  limited keywords { codec with read }

let word = refine (fun text -> if text = "" then Some "empty" else None) [ ("minLength", `Int 1) ] text

(* A schema counts characters, of which a text has no more than bytes. *)
let text_up_to most =
  let check text =
    if String.length text <= most then None else Some (Printf.sprintf "longer than %d bytes" most)
  in
  refine check [ ("maxLength", `Int most) ] word

let truth =
  make (function `Bool b -> Ok b | json -> not_a "true or false" json) (fun b -> `Bool b) (typed "boolean" [])

let bounds least most = List.filter_map Fun.id [ least; most ]

let range what show least most =
  match least, most with
  | None, None -> what
  | Some least, None -> Printf.sprintf "%s from %s" what (show least)
  | None, Some most -> Printf.sprintf "%s up to %s" what (show most)
  | Some least, Some most -> Printf.sprintf "%s from %s to %s" what (show least) (show most)

let outside compare least most x =
  Option.fold least ~none:false ~some:(fun least -> compare x least < 0)
  || Option.fold most ~none:false ~some:(fun most -> compare x most > 0)

let limits write least most =
  bounds
    (Option.map (fun x -> ("minimum", write x)) least)
    (Option.map (fun x -> ("maximum", write x)) most)

let whole ?least ?most () =
  let write i : json = `Int i in
  let check i =
    if outside Int.compare least most i then
      Some (Printf.sprintf "%d, not %s" i (range "a number" string_of_int least most))
    else None
  in
  make (function `Int i -> Ok i | json -> not_a "a whole number" json) write (typed "integer" [])
  |> refine check (limits write least most)

let count = whole ~least:0 ()

let any_number write =
  let read : json -> _ = function
    | `Int i -> Ok (float_of_int i)
    | `Float x when Float.is_finite x -> Ok x
    | json -> not_a "a number" json
  in
  make read write (typed "number" [])

let within write ?least ?most () =
  let check x =
    if outside Float.compare least most x then
      Some (Printf.sprintf "%g, not %s" x (range "a number" (Printf.sprintf "%g") least most))
    else None
  in
  if bounds least most = [] then any_number write
  else refine check (limits Canonical.number least most) (any_number write)

let number ?least ?most () = within Canonical.number ?least ?most ()
let decimal ?least ?most () = within (fun x -> `Float x) ?least ?most ()
let any = make Result.ok Fun.id (plain [])

let object_ =
  make (function `Assoc _ as json -> Ok json | json -> not_a "an object" json) Fun.id (typed "object" [])

let enum names =
  let all = List.map fst names in
  let read : json -> _ = function
    | `String name -> (
        match List.find_opt (fun (other, _) -> String.equal name other) names with
        | Some (_, x) -> Ok x
        | None -> wrong (Printf.sprintf "'%s', not one of %s" name (String.concat ", " all)))
    | json -> not_a "a text" json
  in
  let write x : json = `String (fst (List.find (fun (_, other) -> other = x) names)) in
  make read write (plain [ ("enum", texts all) ])

let const value =
  let read json = if json = value then Ok () else not_a (Canonical.to_string value) json in
  make read (fun () -> value) (plain [ ("const", value) ])

let nullable codec =
  let read : json -> _ = function `Null -> Ok None | json -> Result.map Option.some (codec.read json) in
  let write = function None -> `Null | Some x -> codec.write x in
  { read; write; schema = lazy (or_null (Lazy.force codec.schema)) }

(* Ways and boundaries have many points: neither direction takes stack for each. *)
let each step read xs =
  let rec go i found = function
    | [] -> Ok (List.rev found)
    | x :: rest -> ( match read x with Ok y -> go (i + 1) (y :: found) rest | Error _ as e -> below (step i x) e)
  in
  go 0 [] xs

let mapped f xs = List.rev (List.rev_map f xs)

let list ?least ?most codec =
  let too_many n = outside Int.compare least most n in
  let read : json -> _ = function
    | `List items ->
      let limited = least <> None || most <> None in
      if limited && too_many (List.length items) then
        wrong (Printf.sprintf "a list of %d, not of %s" (List.length items) (range "a number" string_of_int least most))
      else each (fun i _ -> Item i) codec.read items
    | json -> not_a "a list" json
  in
  let schema =
    lazy
      (let item = Lazy.force codec.schema in
       let number name = Option.map (fun n -> (name, (`Int n : json))) in
       let bounds = bounds (number "minItems" least) (number "maxItems" most) in
       { item with keywords = ("type", `String "array") :: ("items", json_of item) :: bounds })
  in
  { read; write = (fun xs -> `List (mapped codec.write xs)); schema }

let map codec =
  let entry (name, json) = Result.map (fun x -> (name, x)) (codec.read json) in
  let read : json -> _ = function
    | `Assoc members -> each (fun _ (name, _) -> Member name) entry members
    | json -> not_a "an object" json
  in
  let schema =
    lazy
      (let item = Lazy.force codec.schema in
       { item with keywords = [ ("type", `String "object"); ("additionalProperties", json_of item) ] })
  in
  { read; write = (fun xs -> `Assoc (mapped (fun (name, x) -> (name, codec.write x)) xs)); schema }

let conv of_a to_a codec =
  let read json =
    let* x = codec.read json in
    match of_a x with Ok _ as ok -> ok | Error why -> wrong why
  in
  { read; write = (fun y -> codec.write (to_a y)); schema = codec.schema }

let possibilities schema =
  match schema.keywords with [ ("oneOf", `List all) ] -> all | _ -> [ json_of schema ]

let one_of schemas =
  { keywords = [ ("oneOf", `List (List.concat_map possibilities schemas)) ];
    definitions = together (List.map (fun schema -> schema.definitions) schemas) }

type ('a, 'b) form = { codec : 'b t; made_of : 'b -> 'a }

type 'a some_form = Form : ('a, 'b) form -> 'a some_form

type 'a formed = As : ('a, 'b) form * 'b -> 'a formed

let form codec made_of = { codec; made_of }

let either recognise choose forms =
  let read json =
    let (Form f) = recognise json in
    match f.codec.read json with Ok content -> Ok (f.made_of content) | Error _ as fault -> fault
  in
  let write x =
    let (As (f, content)) = choose x in
    f.codec.write content
  in
  { read; write; schema = lazy (one_of (List.map (fun (Form f) -> Lazy.force f.codec.schema) forms)) }

(* {1 Objects} *)

(* The members of an object: [alternatives] has the possibilities of each union among them. *)
type shape = {
  properties : (string * schema) list;
  required : string list;
  alternatives : shape list list;
  others : (string * json) list;  (* other keywords *)
}

let no_members = { properties = []; required = []; alternatives = []; others = [] }

let both a b =
  { properties = a.properties @ b.properties;
    required = a.required @ b.required;
    alternatives = a.alternatives @ b.alternatives;
    others = a.others @ b.others }

type ('o, 'a) fields = {
  get : Field.members -> ('a, fault) result;
  put : 'o -> Field.members -> Field.members;  (* in front of others *)
  shape : shape Lazy.t;
}

let rec schema_of_shape ?(is_whole = true) shape =
  let unless_empty name value xs = if xs = [] then [] else [ (name, value xs) ] in
  let choices = List.map (fun each -> one_of (List.map (schema_of_shape ~is_whole:false) each)) shape.alternatives in
  let properties = mapped (fun (name, schema) -> (name, json_of schema)) shape.properties in
  let alternatives =
    match choices with
    | [] -> []
    | [ one ] -> one.keywords
    | several -> [ ("allOf", `List (List.map json_of several)) ]
  in
  { keywords =
      (if is_whole then [ ("type", `String "object") ] else [])
      @ unless_empty "properties" (fun properties -> `Assoc properties) properties
      @ unless_empty "required" texts shape.required
      @ alternatives @ shape.others;
    definitions =
      together (List.map (fun s -> s.definitions) (List.map snd shape.properties @ choices)) }

let record fields =
  let read : json -> _ = function `Assoc members -> fields.get members | json -> not_a "an object" json in
  { read;
    write = (fun x -> `Assoc (fields.put x []));
    schema = lazy (schema_of_shape (Lazy.force fields.shape)) }

let closed fields =
  let known = lazy (List.map fst (Lazy.force fields.shape).properties) in
  let is_known (name, _) = List.mem name (Lazy.force known) in
  let codec = record fields in
  let read json =
    let* x = codec.read json in
    match json with
    | `Assoc members when not (List.for_all is_known members) ->
      let name, _ = List.find (fun member -> not (is_known member)) members in
      Error { path = [ Member name ]; why = "not a known member" }
    | _ -> Ok x
  in
  limited [ ("additionalProperties", `Bool false) ] { codec with read }

let member doc name codec ~required =
  let codec = Option.fold doc ~none:codec ~some:(fun doc -> described doc codec) in
  lazy
    { no_members with
      properties = [ (name, Lazy.force codec.schema) ];
      required = (if required then [ name ] else []) }

(* Journals of long runs have millions of members: names are compared as strings, not as any values. *)
let rec find name = function
  | [] -> None
  | (name', json) :: rest -> if String.equal name name' then Some json else find name rest

let missing name = Error { path = [ Member name ]; why = "missing" }

let read_member name codec json =
  match codec.read json with Ok _ as ok -> ok | Error _ as fault -> below (Member name) fault

let field ?doc name codec get =
  { get =
      (fun members -> match find name members with Some json -> read_member name codec json | None -> missing name);
    put = (fun x rest -> (name, codec.write (get x)) :: rest);
    shape = member doc name codec ~required:true }

let given ~null name members =
  match find name members with Some `Null when null -> None | (Some _ | None) as found -> found

let optional ?doc ?(null = false) name codec get =
  { get =
      (fun members ->
         match given ~null name members with
         | Some json -> Result.map Option.some (read_member name codec json)
         | None -> Ok None);
    put = (fun x rest -> match get x with Some y -> (name, codec.write y) :: rest | None -> rest);
    shape = member doc name codec ~required:false }

let default ?doc ?(null = false) ?(always = false) x name codec get =
  { get =
      (fun members ->
         match given ~null name members with Some json -> read_member name codec json | None -> Ok x);
    put =
      (fun o rest ->
         let y = get o in
         if (not always) && y = x then rest else (name, codec.write y) :: rest);
    shape = member doc name codec ~required:false }

let return x = { get = (fun _ -> Ok x); put = (fun _ rest -> rest); shape = Lazy.from_val no_members }

let ( let+ ) fields f =
  { fields with get = (fun members -> match fields.get members with Ok x -> Ok (f x) | Error _ as fault -> fault) }

let ( and+ ) a b =
  { get =
      (fun members ->
         match a.get members with
         | Error _ as fault -> fault
         | Ok x -> ( match b.get members with Ok y -> Ok (x, y) | Error _ as fault -> fault));
    put = (fun o rest -> a.put o (b.put o rest));
    shape = lazy (both (Lazy.force a.shape) (Lazy.force b.shape)) }

let part get fields = { fields with put = (fun x rest -> fields.put (get x) rest) }
let ( @& ) a b = ( and+ ) (part fst a) (part snd b)
let one ?doc name codec = field ?doc name codec Fun.id
let fixed name value = field name (const value) ignore

let check f fields =
  let get members =
    let* x = fields.get members in
    match f x with Ok _ as ok -> ok | Error why -> wrong why
  in
  { fields with get }

let requiring needs fields =
  let needs : json = `Assoc (List.map (fun (name, others) -> (name, texts others)) needs) in
  let others = [ ("dependentRequired", needs) ] in
  { fields with shape = lazy (both (Lazy.force fields.shape) { no_members with others }) }

let members fields x = fields.put x []
let of_members fields found = Result.map_error text_of_fault (fields.get found)

(* {1 Unions} *)

type ('a, 'b) case = { name : string; fields : ('b, 'b) fields; make : 'b -> 'a }

type 'a variant = Case : ('a, 'b) case -> 'a variant

type 'a chosen = Is : ('a, 'b) case * 'b -> 'a chosen

let case name fields make = { name; fields; make }
let constant name x = case name (return ()) (fun () -> x)
let names variants = List.map (fun (Case c) -> c.name) variants

let rec variant_called name = function
  | [] -> None
  | (Case c as variant) :: rest -> if String.equal c.name name then Some variant else variant_called name rest

let read_case c members =
  match c.fields.get members with Ok content -> Ok (c.make content) | Error _ as fault -> fault

let unknown name variants =
  Printf.sprintf "'%s', not one of %s" name (String.concat ", " (names variants))

let union_around ~tag common variants choose =
  let get members =
    match find tag members with
    | None -> missing tag
    | Some (`String name) -> (
        match variant_called name variants with
        | Some (Case c) -> (
            match common.get members with
            | Error _ as fault -> fault
            | Ok x -> ( match read_case c members with Ok y -> Ok (x, y) | Error _ as fault -> fault))
        | None -> Error { path = [ Member tag ]; why = unknown name variants })
    | Some json -> below (Member tag) (not_a "a text" json)
  in
  let put (x, y) rest =
    let (Is (c, content)) = choose y in
    (tag, `String c.name) :: common.put x (c.fields.put content rest)
  in
  let possibility (Case c) =
    let tagged = (tag, plain [ ("const", `String c.name) ]) in
    both { no_members with properties = [ tagged ]; required = [ tag ] } (Lazy.force c.fields.shape)
  in
  let alternatives = [ List.map possibility variants ] in
  { get; put; shape = lazy (both (Lazy.force common.shape) { no_members with alternatives }) }

let union ~tag variants choose =
  let+ (), x = part (fun x -> ((), x)) (union_around ~tag (return ()) variants choose) in
  x

let keyed variants choose =
  let get = function
    | ((name, _) :: _ : Field.members) as members -> (
        match variant_called name variants with
        | Some (Case c) -> read_case c members
        | None -> wrong ("an object that begins with " ^ unknown name variants))
    | [] -> wrong ("empty, not an object with one of " ^ String.concat ", " (names variants))
  in
  let put x rest =
    let (Is (c, content)) = choose x in
    c.fields.put content rest
  in
  let possibility (Case c) = Lazy.force c.fields.shape in
  record { get; put; shape = lazy { no_members with alternatives = [ List.map possibility variants ] } }

let variant variants name =
  let reader (Case c) members = Result.map_error text_of_fault (read_case c members) in
  Option.map reader (variant_called name variants)

(* {1 Schemas} *)

let reference uri = [ ("$ref", (`String uri : json)) ]

let named name codec =
  let schema =
    lazy
      (let whole = Lazy.force codec.schema in
       { keywords = reference ("#/$defs/" ^ name); definitions = (name, json_of whole) :: whole.definitions })
  in
  { codec with schema }

let fix name f =
  let rec codec =
    lazy
      (let itself =
         { read = (fun json -> (Lazy.force codec).read json);
           write = (fun x -> (Lazy.force codec).write x);
           schema = Lazy.from_val (plain (reference ("#/$defs/" ^ name))) }
       in
       f itself)
  in
  named name (Lazy.force codec)

let elsewhere uri codec = { codec with schema = Lazy.from_val (plain (reference uri)) }
