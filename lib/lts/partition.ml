type t = { block : int array; representative : int array }

let blocks p = Array.length p.representative
let block p s = p.block.(s)

let strong g =
  let refinement = Refinement.create g in
  Refinement.run refinement;
  let unknown = -1 in
  let number = Array.make (Refinement.blocks refinement) unknown in
  let representative = Array.make (Refinement.blocks refinement) 0 in
  let numbered = ref 0 in
  let block s =
    let b = Refinement.block refinement s in
    if number.(b) = unknown then begin
      number.(b) <- !numbered;
      representative.(!numbered) <- s;
      incr numbered
    end;
    number.(b)
  in
  { block = Array.init (Graph.states g) block; representative }

let quotient g p =
  let builder = Graph.Builder.create () in
  let renamed = Array.init (Graph.labels g) (fun l -> Graph.Builder.label builder (Graph.label g l)) in
  Array.iteri
    (fun b s -> Graph.iter_from g s (fun l s' -> Graph.Builder.add_numbered builder b renamed.(l) p.block.(s')))
    p.representative;
  let text = Option.map (fun text b -> text p.representative.(b)) (Graph.text g) in
  Graph.Builder.finish ~initial:p.block.(Graph.initial g) ~states:(blocks p) ?text builder

let minimal g =
  let g = Reachability.trim g in
  Reachability.trim (quotient g (strong g))
