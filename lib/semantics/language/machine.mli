(** The abstract machine that runs the program's code: the script between its visible steps, and the code of guards,
    actions and error handlers in one go. Control is data (an expression in focus and a stack of frames), so that a
    configuration can be stored, compared and resumed, and deep recursion of a program costs heap, not stack. {!Code}
    has the types of the surroundings, effects and requests of code. *)

open Core

(** {1:machine Machines} *)

(** The rest of a loop: elements from an index on (-1: the loop waits for its subject), or numbers up to and with the
    last, up or down. *)
type items = Items of value array * int | Counting of int * int

(** The use of the value of the code in focus. *)
type frame =
  | Arguments of { operation : operation; at : site; evaluated : value list;  (** latest first *)
                   remaining : expression list }
  | Assign_local of int
  | Assign_global of int
  | Choose of expression * expression
  | Rest of expression list
  | Loop_test of expression * expression
  | Loop_body of expression * expression
  | Next_item of int * items * expression
  | Leave of value array  (** a call ends: the locals of the caller *)
  | Iterate of {
      iteration : Code.iteration;
      closure : closure;
      subject : value;
      items : value array;
      index : int;  (** of the item whose result is awaited *)
      gathered : value list;  (** latest first *)
      at : site;
    }

(** The next thing to do: evaluate an expression, or give a value to the top of the stack. *)
type focus = Evaluate of expression | Give of value

type t = { focus : focus; locals : value array; stack : frame list; calls : int;  (** as many as [Leave] in [stack] *)
           at : site }
(** Code about to run, or waiting for a value. The type is public so that machines can be stored. {!run} may raise
    [Invalid_argument] on a machine made of parts that do not belong together. *)

val compare : t -> t -> int
(** A total order: machines of one program are equal if they go on alike. *)

val hash : t -> int
(** Equal machines have equal hashes. *)

val site : t -> site
(** [site m] is the place in the program where [m] stands. *)

val call : closure -> value list -> t
(** [call c arguments] is [c] about to run. Surplus arguments are dropped, as for handlers that ignore their error. *)

val give : value -> t -> t
(** [give x m] is [m], which waited, going on with [x]. *)

val is_leaving : t -> bool
(** Whether [m] runs what [onInterrupt] executes. *)

val keep_readings : t -> t
(** [keep_readings m] is [m] once a step is over: its readings are known by the places where [m] keeps them
    ({!Reading.keep}). *)

(** {1:running Running} *)

val name_of_call : subject:string option -> member:string -> string
(** [name_of_call ~subject ~member] is how labels and journals name a call of the host: ["getSupplier"],
    ["queue.await"]. *)

val compare_request : Code.request -> Code.request -> int
(** A total order. *)

(** The reason why a machine stops. *)
type stop =
  | Exhausted  (** the fuel ran out; the machine can go on *)
  | Finished of value
  | Left_off  (** the task of [onInterrupt] is over *)
  | Did of Code.deed  (** in script mode: something that others see, the latest of [deeds]; the machine can go on *)
  | Waits of Code.request  (** in script mode; go on with {!give} *)
  | Halted of string  (** the code called [halt] *)
  | Faulted of Fault.t

val run : fuel:int -> Code.context -> t -> (stop * t * Code.context) Decision.t
(** [run ~fuel context m] runs [m] until it stops, for at most [fuel] expressions. If it depends on something that
    the world leaves open, it goes on in each way, in a world in which that is supposed. *)
