(* Uses that are found, and from [fine] on uses that are not. *)

type part = { hidden : Hidden.t option; name : string }
type 'a tree = Leaf | Node of 'a tree * 'a * 'a tree

let equal (a : part) b = a = b
let order (a : part tree) b = compare a b
let known (x : Hidden.t) xs = List.mem x xs
let functions (f : int -> int) g = f == g || f = g
let table : (Hidden.t, int) Hashtbl.t = Hashtbl.create 7
let note x = Hashtbl.replace table x 1
let fine a b = String.equal a.name b.name
let none (a : Hidden.t option) = a = None
let names a b = a.name = b.name
let trees (a : int tree) b = a = b
let _ = (equal, order, known, functions, note, fine, none, names, trees)
