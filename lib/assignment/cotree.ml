type 'a tree = Leaf of 'a | Disjoint of 'a tree list | Shared of 'a tree list

type kind = A_leaf of int | All_different | Any

type t = { parent : int array; kind : kind array }

let of_tree tree =
  let rec visit todo count parents kinds leaf_count leaves =
    match todo with
    | [] ->
      ( { parent = Array.of_list (List.rev parents); kind = Array.of_list (List.rev kinds) },
        Array.of_list (List.rev leaves) )
    | (parent, tree) :: todo -> (
        let inner kind children =
          let todo = List.rev_append (List.rev_map (fun child -> (count, child)) children) todo in
          visit todo (count + 1) (parent :: parents) (kind :: kinds) leaf_count leaves
        in
        match tree with
        | Leaf leaf ->
          visit todo (count + 1) (parent :: parents) (A_leaf leaf_count :: kinds) (leaf_count + 1) (leaf :: leaves)
        | Disjoint children -> inner All_different children
        | Shared children -> inner Any children)
  in
  visit [ (-1, tree) ] 0 [] [] 0 []

let restriction { parent; kind } =
  let leaf_count =
    Array.fold_left (fun count kind -> match kind with A_leaf _ -> count + 1 | All_different | Any -> count) 0 kind
  in
  let node_of_leaf = Array.make leaf_count 0 in
  Array.iteri
    (fun node kind ->
       match kind with
       | A_leaf leaf -> node_of_leaf.(leaf) <- node
       | All_different | Any -> ())
    kind;
  let children = Array.make (Array.length parent) 0 (* that lead to chosen leaves *) in
  let becomes = Array.make (Array.length parent) (-1) in
  fun leaves ->
    let touched = ref [] in
    let rec climb node =
      if node >= 0 then begin
        children.(node) <- children.(node) + 1;
        if children.(node) = 1 then begin
          touched := node :: !touched;
          climb parent.(node)
        end
      end
    in
    Array.iter (fun leaf -> climb node_of_leaf.(leaf)) leaves;
    let touched = List.sort Int.compare !touched in
    let count = ref 0 and leaf_count = ref 0 and parents = ref [] and kinds = ref [] in
    let kind_of = Hashtbl.create 16 in
    let add node above kind =
      becomes.(node) <- !count;
      Hashtbl.replace kind_of !count kind;
      parents := above :: !parents;
      kinds := kind :: !kinds;
      incr count
    in
    let copy node =
      let above = if parent.(node) < 0 then -1 else becomes.(parent.(node)) in
      match kind.(node) with
      | A_leaf _ ->
        add node above (A_leaf !leaf_count);
        incr leaf_count
      | (All_different | Any) as kind ->
        if children.(node) = 1 || (above >= 0 && Hashtbl.find kind_of above = kind) then becomes.(node) <- above
        else add node above kind
    in
    List.iter copy touched;
    List.iter (fun node -> children.(node) <- 0) touched;
    { parent = Array.of_list (List.rev !parents); kind = Array.of_list (List.rev !kinds) }

let bottom_up { parent; kind } ~leaf ~inner =
  let count = Array.length parent in
  let pending = Array.make count [] in
  let results = Array.make count None in
  for node = count - 1 downto 0 do
    let result =
      match kind.(node) with
      | A_leaf row -> leaf row
      | (All_different | Any) as kind -> inner node kind pending.(node)
    in
    results.(node) <- Some result;
    if parent.(node) >= 0 then pending.(parent.(node)) <- result :: pending.(parent.(node))
  done;
  Array.map Option.get results

let leaves cotree = bottom_up cotree ~leaf:(fun row -> [ row ]) ~inner:(fun _ _ children -> List.concat children)

let is_free cotree =
  bottom_up cotree ~leaf:(fun _ -> true) ~inner:(fun _ kind children -> kind = Any && List.for_all Fun.id children)

let simple_branches cotree =
  let leaves = leaves cotree and is_free = is_free cotree in
  match cotree.kind.(0) with
  | A_leaf _ | Any -> if is_free.(0) then Some [ leaves.(0) ] else None
  | All_different ->
    let branches = ref [] and simple = ref true in
    Array.iteri
      (fun node parent ->
         if parent = 0 then begin
           branches := leaves.(node) :: !branches;
           if not is_free.(node) then simple := false
         end)
      cotree.parent;
    if !simple then Some (List.rev !branches) else None

let exclusions cotree =
  let leaves = leaves cotree in
  let count = List.length leaves.(0) in
  let excluded = Array.make count [] in
  let exclude others row = excluded.(row) <- List.rev_append others excluded.(row) in
  let children = Array.make (Array.length cotree.parent) [] in
  Array.iteri (fun node parent -> if parent >= 0 then children.(parent) <- node :: children.(parent)) cotree.parent;
  Array.iteri
    (fun node kind ->
       match kind with
       | A_leaf _ | Any -> ()
       | All_different ->
         List.iter
           (fun child ->
              List.iter
                (fun sibling -> if sibling <> child then List.iter (exclude leaves.(sibling)) leaves.(child))
                children.(node))
           children.(node))
    cotree.kind;
  Array.map (fun rows -> Array.of_list (List.sort Int.compare rows)) excluded

(* Parts as triples: how many leaves, which, and the least [choice] among them; the largest part first. *)
let cliques cotree ~choice =
  let rec join parts others =
    match (parts, others) with
    | [], rest | rest, [] -> rest
    | (count, rows, least) :: parts, (count', rows', least') :: others ->
      (count + count', List.rev_append rows' rows, min least least') :: join parts others
  in
  let inner _ kind children =
    match kind with
    | All_different -> List.fold_left join [] children
    | A_leaf _ | Any ->
      List.stable_sort
        (fun (count, _, least) (count', _, least') ->
           match Int.compare count' count with 0 -> Int.compare least least' | order -> order)
        (List.concat children)
  in
  let parts = bottom_up cotree ~leaf:(fun row -> [ (1, [ row ], choice.(row)) ]) ~inner in
  Array.of_list (List.map (fun (_, rows, _) -> Array.of_list (List.sort Int.compare rows)) parts.(0))
